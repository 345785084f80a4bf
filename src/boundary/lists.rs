//! Many short lists that are put together again and again, without memory of their own for each.

/// No item follows.
const NONE: u32 = u32::MAX;

/// Lists of items; each item is in one of them.
#[derive(Clone, Debug)]
pub(super) struct Lists {
    first: Vec<u32>,
    last: Vec<u32>,
    len: Vec<u32>,
    next: Vec<u32>,
}

impl Lists {
    /// As many lists as asked for; item `i` is in list `list_of[i]`.
    pub fn of(count: usize, list_of: impl ExactSizeIterator<Item = u32>) -> Lists {
        let next = vec![NONE; list_of.len()];
        let mut lists =
            Lists { first: vec![NONE; count], last: vec![NONE; count], len: vec![0; count], next };
        for (item, list) in (0..).zip(list_of) {
            let list = list as usize;
            match lists.last[list] {
                NONE => lists.first[list] = item,
                last => lists.next[last as usize] = item,
            }
            lists.last[list] = item;
            lists.len[list] += 1;
        }
        lists
    }

    /// Number of lists, empty ones included.
    pub fn count(&self) -> usize {
        self.first.len()
    }

    /// Number of items in a list.
    pub fn len(&self, list: usize) -> u32 {
        self.len[list]
    }

    /// The items of a list.
    pub fn items(&self, list: usize) -> impl Iterator<Item = u32> + '_ {
        let some = |item: u32| (item != NONE).then_some(item);
        std::iter::successors(some(self.first[list]), move |&item| some(self.next[item as usize]))
    }

    /// Puts the items of a list behind those of another one.
    pub fn append(&mut self, into: usize, from: usize) {
        if self.len[from] == 0 {
            return;
        }
        match self.last[into] {
            NONE => self.first[into] = self.first[from],
            last => self.next[last as usize] = self.first[from],
        }
        self.last[into] = self.last[from];
        self.len[into] += self.len[from];
        (self.first[from], self.last[from], self.len[from]) = (NONE, NONE, 0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_keep_their_order_when_they_are_put_together() {
        let mut lists = Lists::of(4, [2, 0, 2, 0, 3].into_iter());
        let items = |lists: &Lists, list| lists.items(list).collect::<Vec<u32>>();
        assert_eq!(items(&lists, 2), [0, 2]);
        for from in [2, 1, 3] {
            lists.append(0, from);
        }
        assert_eq!(items(&lists, 0), [1, 3, 0, 2, 4]);
        lists.append(1, 0);
        assert_eq!((items(&lists, 1), lists.len(1), lists.len(0)), (vec![1, 3, 0, 2, 4], 5, 0));
        assert!(items(&lists, 0).is_empty() && items(&lists, 2).is_empty());
    }
}
