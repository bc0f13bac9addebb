//! Panes: two methods side by side, with a divider between them.

use fastphong::shading::Variant;
use std::vec::Vec;

/// A side of the window.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// Left of the divider.
    Left,
    /// Right of the divider.
    Right,
}

impl Side {
    /// Returns the other side.
    pub fn other(self) -> Side {
        match self {
            Side::Left => Side::Right,
            Side::Right => Side::Left,
        }
    }
}

/// The methods to choose from, the two that are chosen, and the divider.
#[derive(Clone, Debug)]
pub struct Panes {
    methods: Vec<Variant>,
    /// The indices of the methods on the left and on the right.
    chosen: [usize; 2],
    /// The fraction of the width that is left of the divider, 0..=1.
    divider: f64,
    /// The only side that is shown; `None` if both are.
    alone: Option<Side>,
}

/// The fraction of the width that remains on either side, so that the divider stays visible.
const LEAST: f64 = 0.02;

/// The colours of the divider: white, with black edges that show on a white picture.
const LINE: [u32; 3] = [0xff00_0000, 0xffff_ffff, 0xff00_0000];

impl Panes {
    /// The largest number of methods: one for each key.
    pub const MOST: usize = 9;

    /// Makes panes that show the first two of `methods`, with the divider in the middle. A single
    /// method has the window for itself.
    ///
    /// # Panics
    /// If `methods` is empty.
    pub fn new(methods: Vec<Variant>) -> Panes {
        assert!(!methods.is_empty(), "a method to show");
        let second = 1.min(methods.len() - 1);
        Panes {
            methods,
            chosen: [0, second],
            divider: 0.5,
            alone: (second == 0).then_some(Side::Left),
        }
    }

    /// Returns the method on a side.
    pub fn method(&self, side: Side) -> &Variant {
        &self.methods[self.index(side)]
    }

    /// Returns the index of the method on a side.
    pub fn index(&self, side: Side) -> usize {
        self.chosen[side as usize]
    }

    /// Returns the sides that are shown, from the left.
    pub fn shown(&self) -> &[Side] {
        match self.alone {
            None => &[Side::Left, Side::Right],
            Some(Side::Left) => &[Side::Left],
            Some(Side::Right) => &[Side::Right],
        }
    }

    /// Shows the method at `index` on `side`, and makes the side visible. Does nothing if there is
    /// no such method.
    pub fn choose(&mut self, side: Side, index: usize) {
        if index < self.methods.len() {
            self.chosen[side as usize] = index;
            if self.alone == Some(side.other()) {
                self.alone = None;
            }
        }
    }

    /// Exchanges left and right.
    pub fn swap(&mut self) {
        self.chosen.swap(0, 1);
    }

    /// Switches from both sides to the left one, then to the right one, then back to both.
    pub fn show_next(&mut self) {
        self.alone = match self.alone {
            None => Some(Side::Left),
            Some(Side::Left) => Some(Side::Right),
            Some(Side::Right) => None,
        };
    }

    /// Returns how many columns are left of the divider in a window `width` pixels wide. If only
    /// one side is shown, it has all.
    pub fn split(&self, width: usize) -> usize {
        match self.alone {
            None => (self.divider * width as f64).round() as usize,
            Some(Side::Left) => width,
            Some(Side::Right) => 0,
        }
    }

    /// Moves the divider to column `x`, if there is a divider.
    pub fn divide_at(&mut self, x: f64, width: usize) {
        if self.alone.is_none() && width > 0 {
            self.divider = (x / width as f64).clamp(LEAST, 1.0 - LEAST);
        }
    }

    /// Moves the divider to the right by a fraction of the width.
    pub fn divide_by(&mut self, part: f64) {
        self.divide_at(self.divider + part, 1);
    }

    /// Returns the side that column `x` is on.
    pub fn side_at(&self, x: f64, width: usize) -> Side {
        if x < self.split(width) as f64 {
            Side::Left
        } else {
            Side::Right
        }
    }

    /// True if column `x` is at most `reach` pixels from the divider.
    pub fn is_on_divider(&self, x: f64, width: usize, reach: f64) -> bool {
        self.alone.is_none() && (x - self.split(width) as f64).abs() <= reach
    }

    /// Copies both pictures to their sides of `window`, and draws the divider with a knob in its
    /// middle. The window and the pictures are `width` pixels wide and equally high. `scale` is how
    /// many physical pixels a logical pixel has.
    pub fn compose(&self, window: &mut [u32], pictures: [&[u32]; 2], width: usize, scale: f64) {
        let split = self.split(width);
        let [left, right] = pictures.map(|picture| picture.chunks_exact(width));
        for ((row, left), right) in window.chunks_exact_mut(width).zip(left).zip(right) {
            row[..split].copy_from_slice(&left[..split]);
            row[split..].copy_from_slice(&right[split..]);
        }
        if self.alone.is_none() {
            line(window, width, split, scale);
        }
    }
}

/// Draws the divider left and right of column `split`.
fn line(window: &mut [u32], width: usize, split: usize, scale: f64) {
    let thick = scale.round().max(1.0) as usize;
    let (middle, radius) = (window.len() / width / 2, (9.0 * scale) as usize);
    for (y, row) in window.chunks_exact_mut(width).enumerate() {
        // The knob is a white disc in a black ring. `half` returns half the width of a disc in this
        // row, 0 outside it.
        let up = y.abs_diff(middle);
        let half = |radius: usize| (radius.pow(2).saturating_sub(up.pow(2)) as f64).sqrt() as usize;
        let (disc, ring) = (half(radius), half(radius + thick));
        let mut paint = |half: usize, colour: u32| {
            let first = split.saturating_sub(half);
            row[first..(split + half).min(width)].fill(colour);
        };
        paint(ring.max(2 * thick), LINE[0]);
        paint(disc.max(thick), LINE[1]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use fastphong::shading::METHODS;
    use std::string::ToString;
    use std::vec;

    fn panes(count: usize) -> Panes {
        let methods = METHODS.iter().take(count);
        Panes::new(methods.map(|method| method.variant()).collect())
    }

    #[test]
    fn the_first_two_are_shown_half_and_half_and_one_is_shown_alone() {
        let two = panes(5);
        assert_eq!(two.shown(), [Side::Left, Side::Right]);
        assert_eq!(two.split(101), 51);
        let names = [Side::Left, Side::Right].map(|side| two.method(side).to_string());
        assert_eq!(names, [METHODS[0].info.name, METHODS[1].info.name]);
        let one = panes(1);
        assert_eq!((one.shown(), one.split(100)), (&[Side::Left][..], 100));
    }

    #[test]
    fn an_index_chooses_for_one_side_only_and_one_too_high_nothing() {
        let mut panes = panes(4);
        panes.choose(Side::Right, 3);
        panes.choose(Side::Left, 4);
        assert_eq!(panes.chosen, [0, 3]);
        panes.swap();
        assert_eq!(panes.chosen, [3, 0]);
        // What is chosen is seen.
        panes.show_next();
        panes.choose(Side::Right, 2);
        assert_eq!(panes.shown(), [Side::Left, Side::Right]);
    }

    #[test]
    fn sides_are_shown_in_turn() {
        let mut panes = panes(2);
        let mut splits = Vec::new();
        for _ in 0..4 {
            splits.push(panes.split(10));
            panes.show_next();
        }
        assert_eq!(splits, [5, 10, 0, 5]);
    }

    #[test]
    fn the_divider_follows_the_pointer_and_never_leaves() {
        let mut panes = panes(2);
        panes.divide_at(30.0, 100);
        assert_eq!(panes.split(100), 30);
        assert_eq!(
            panes.split(200),
            60,
            "it keeps its place when the window grows"
        );
        assert_eq!(panes.side_at(29.9, 100), Side::Left);
        assert_eq!(panes.side_at(30.0, 100), Side::Right);
        assert!(panes.is_on_divider(38.0, 100, 8.0) && !panes.is_on_divider(38.1, 100, 8.0));
        panes.divide_by(-0.05);
        assert_eq!(panes.split(100), 25);
        for (x, expected) in [(-1e9, 2), (1e9, 98)] {
            panes.divide_at(x, 100);
            assert_eq!(panes.split(100), expected);
        }
        panes.divide_at(5.0, 0);
        assert_eq!(panes.split(0), 0);
        panes.show_next();
        assert!(!panes.is_on_divider(98.0, 100, 8.0), "there is none");
    }

    #[test]
    fn each_side_has_its_picture_and_the_line_is_between() {
        let mut panes = panes(2);
        let (width, height) = (60, 50);
        let mut window = vec![0; width * height];
        let pictures = [vec![1; width * height], vec![2; width * height]];
        let pictures = [&pictures[0][..], &pictures[1][..]];
        panes.compose(&mut window, pictures, width, 1.0);
        let row = &window[..width];
        assert_eq!(&row[..28], [1; 28]);
        assert_eq!(row[28..32], [LINE[0], LINE[1], LINE[1], LINE[2]]);
        assert_eq!(&row[32..], [2; 28]);
        // In the middle is the knob.
        let middle = &window[25 * width..26 * width];
        assert!(middle[21..39].iter().all(|pixel| *pixel == LINE[1]));
        assert_eq!((middle[20], middle[19]), (LINE[0], 1));
        // At the edges it is cut off, in any window.
        for (width, x, scale) in [
            (60, 0.0, 1.0),
            (60, 60.0, 3.0),
            (1, 0.5, 2.0),
            (3, 1.0, 1.0),
        ] {
            panes.divide_at(x, width);
            let mut window = vec![0; width * 2];
            panes.compose(
                &mut window,
                [&pictures[0][..width * 2], &pictures[1][..width * 2]],
                width,
                scale,
            );
        }
        panes.show_next();
        panes.compose(&mut window, pictures, width, 1.0);
        assert!(window.iter().all(|pixel| *pixel == 1));
    }
}
