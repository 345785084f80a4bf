//! What was wrong with the form of a file and could be put right.

use crate::io::{Place, Warning};
use std::collections::BTreeMap;

/// A fault of form that costs nothing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Mend {
    BlankLine,
    Number,
    NoSection,
    NestedSection,
    NoSeqend,
    StrayVertex,
    VertexCount,
    NoEndblk,
    DoubleBlock,
    CodePage,
    Tail,
}

impl Mend {
    fn what(self) -> &'static str {
        match self {
            Mend::BlankLine => "blank lines where a group code should stand, passed over",
            Mend::Number => "numbers with a decimal comma or an exponent D, read as with a point and E",
            Mend::NoSection => "entities outside of any section, read as if in ENTITIES",
            Mend::NestedSection => "sections that begin before the last one has ended",
            Mend::NoSeqend => "polylines without SEQEND, taken to end with their last vertex",
            Mend::StrayVertex => "vertices without a polyline, skipped",
            Mend::VertexCount => {
                "polylines with another number of vertices than they say, read with all they have"
            }
            Mend::NoEndblk => "blocks without ENDBLK, taken to end where the next begins",
            Mend::DoubleBlock => "blocks of a name that was used before, of which the first counts",
            Mend::CodePage => "names in a code page other than Latin-1, whose letters may read differently",
            Mend::Tail => "groups without a group code after the entities, where reading ended",
        }
    }
}

/// Counts of mends, each with the place of the first.
#[derive(Clone, Debug, Default)]
pub(super) struct Mends(BTreeMap<Mend, (usize, Place)>);

impl Mends {
    /// Counts one.
    pub fn count(&mut self, mend: Mend, place: Place) {
        self.0.entry(mend).or_insert((0, place)).0 += 1;
    }

    /// Counts many at once.
    pub fn count_all(&mut self, mend: Mend, counted: Option<(usize, Place)>) {
        if let Some((count, place)) = counted {
            self.0.entry(mend).or_insert((0, place)).0 += count;
        }
    }

    /// One warning for each kind.
    pub fn warnings(self) -> impl Iterator<Item = Warning> {
        self.0.into_iter().map(|(mend, (count, place))| Warning::Mended { what: mend.what(), count, place })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mend_is_told_once_with_its_first_place() {
        let mut mends = Mends::default();
        mends.count(Mend::Number, Place::Line(12));
        mends.count(Mend::Number, Place::Line(40));
        mends.count_all(Mend::BlankLine, Some((3, Place::Line(7))));
        mends.count_all(Mend::Tail, None);
        let told: Vec<String> = mends.warnings().map(|w| w.to_string()).collect();
        assert_eq!(
            told,
            [
                "blank lines where a group code should stand, passed over: 3, the first in line 7",
                "numbers with a decimal comma or an exponent D, read as with a point and E: 2, the first in line 12",
            ]
        );
    }
}
