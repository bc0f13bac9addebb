//! Reads two pictures row by row.

use crate::picture::{LevelRows, Levels};
use alloc::vec;

/// Calls `visit` with the index of each row, from the top, and this row of both pictures. The
/// pictures must have the same size.
pub(super) fn for_each_row(
    reference: &dyn LevelRows,
    actual: &dyn LevelRows,
    mut visit: impl FnMut(usize, &[Levels], &[Levels]),
) {
    debug_assert_eq!(reference.size(), actual.size());
    let [width, height] = reference.size();
    let mut rows = [(); 2].map(|()| vec![Levels([0.0; 4]); width]);
    for y in 0..height {
        let [r, a] = &mut rows;
        reference.level_row(y, r);
        actual.level_row(y, a);
        visit(y, r, a);
    }
}

/// A range of a picture's rows, as a picture.
pub(super) struct Part<'a> {
    pub picture: &'a dyn LevelRows,
    /// The index of the first row.
    pub first: usize,
    /// The number of rows.
    pub height: usize,
}

impl LevelRows for Part<'_> {
    fn size(&self) -> [usize; 2] {
        [self.picture.size()[0], self.height]
    }

    fn level_row(&self, y: usize, levels: &mut [Levels]) {
        debug_assert!(y < self.height);
        self.picture.level_row(self.first + y, levels);
    }
}
