//! Sets that only grow together.

/// Disjoint sets of small numbers, each known by its smallest member.
pub(crate) struct Sets(Vec<u32>);

impl Sets {
    /// Every number below `n` in a set of its own.
    pub fn singles(n: usize) -> Sets {
        Sets((0..n as u32).collect())
    }

    /// The smallest member of the set that `i` is in.
    pub fn find(&mut self, mut i: u32) -> u32 {
        while self.0[i as usize] != i {
            self.0[i as usize] = self.0[self.0[i as usize] as usize];
            i = self.0[i as usize];
        }
        i
    }

    /// The number of the set of each, counted in the order of their smallest members.
    pub fn numbers(mut self) -> Vec<u32> {
        let mut count = 0;
        for i in 0..self.0.len() {
            // What is before has its number.
            let up = self.0[i] as usize;
            self.0[i] = if up == i { count } else { self.0[up] };
            count += u32::from(up == i);
        }
        self.0
    }

    /// Makes one set of two; whether they were two.
    pub fn unite(&mut self, a: u32, b: u32) -> bool {
        let (a, b) = (self.find(a), self.find(b));
        self.0[a.max(b) as usize] = a.min(b);
        a != b
    }
}
