//! The largest connected region of pixels over a threshold.
//!
//! Pixels are connected if they touch at a side or a corner, so that a thin diagonal edge is one
//! region. Rows are read once, from the top. Only regions that reach the last row are kept, so the
//! memory is proportional to the width of the picture.

use alloc::vec::Vec;

/// A connected region of pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LargestRegion {
    /// The number of pixels.
    pub pixels: usize,
    /// The column and row of the upper left corner of its bounding rectangle.
    pub corner: [usize; 2],
    /// The width and height of the rectangle.
    pub size: [usize; 2],
    /// The column and row of the first pixel, in reading order, with the largest error.
    pub worst: [usize; 2],
    /// The largest error in grey levels.
    pub levels: f64,
}

impl LargestRegion {
    /// Makes a region of a run of pixels.
    fn of_run(y: usize, from: usize, errors: &[Option<f64>]) -> LargestRegion {
        let mut region = LargestRegion {
            pixels: errors.len(),
            corner: [from, y],
            size: [errors.len(), 1],
            worst: [from, y],
            levels: 0.0,
        };
        for (x, error) in errors.iter().enumerate() {
            let error = error.unwrap_or(0.0);
            if error > region.levels {
                (region.levels, region.worst) = (error, [from + x, y]);
            }
        }
        region
    }

    /// Adds another region to this one.
    fn join(&mut self, other: &LargestRegion) {
        let reading_order = |[x, y]: [usize; 2]| [y, x];
        let is_worse = other.levels > self.levels
            || other.levels == self.levels
                && reading_order(other.worst) < reading_order(self.worst);
        if is_worse {
            (self.levels, self.worst) = (other.levels, other.worst);
        }
        self.pixels += other.pixels;
        for axis in 0..2 {
            let end = |region: &LargestRegion| region.corner[axis] + region.size[axis];
            let end = end(self).max(end(other));
            self.corner[axis] = self.corner[axis].min(other.corner[axis]);
            self.size[axis] = end - self.corner[axis];
        }
    }

    /// True if this region should be reported instead of `other`: it has more pixels, or as many
    /// but starts farther up, or in the same row but farther left.
    fn is_before(&self, other: &LargestRegion) -> bool {
        let key = |region: &LargestRegion| {
            let [x, y] = region.corner;
            (usize::MAX - region.pixels, y, x)
        };
        key(self) < key(other)
    }
}

/// A run of neighbouring pixels of a row that are over the threshold.
#[derive(Clone, Copy)]
struct Run {
    from: usize,
    /// The column after the last pixel.
    end: usize,
    /// The index of its region in [`Regions::open`].
    region: usize,
}

/// The regions of the rows read so far.
#[derive(Default)]
pub(super) struct Regions {
    rows: usize,
    /// The runs of the last row.
    last: Vec<Run>,
    /// The regions that reach the last row.
    open: Vec<LargestRegion>,
    /// A union-find forest over `open`: the region that each one was joined to while a row is
    /// added, or the region itself.
    joined: Vec<usize>,
    largest: Option<LargestRegion>,
}

impl Regions {
    /// Adds the next row: the errors of its pixels. Pixels for which `is_over` is true belong to
    /// regions.
    pub fn add_row(&mut self, errors: &[Option<f64>], is_over: impl Fn(f64) -> bool) {
        let y = self.rows;
        self.rows += 1;
        let above = core::mem::take(&mut self.last);
        let mut runs = Vec::new();
        let mut first_above = 0;
        let over = |error: &Option<f64>| error.is_some_and(&is_over);
        let mut x = 0;
        while let Some(skipped) = errors[x..].iter().position(over) {
            let from = x + skipped;
            let length = errors[from..].iter().position(|error| !over(error));
            let end = length.map_or(errors.len(), |length| from + length);
            x = end;
            let region = self.open.len();
            self.joined.push(region);
            self.open
                .push(LargestRegion::of_run(y, from, &errors[from..end]));
            // This run has the columns from..end. A run above touches it, at least at a corner, if
            // run.end >= from and run.from <= end. A run above that ends before `from` cannot touch
            // later runs either, so the search starts after it next time.
            while above.get(first_above).is_some_and(|run| run.end < from) {
                first_above += 1;
            }
            let touching = above[first_above..].iter();
            for other in touching.take_while(|run| run.from <= end) {
                self.join(region, other.region);
            }
            runs.push(Run { from, end, region });
        }
        self.last = runs;
        self.close();
    }

    /// Returns the root of the region in the forest. Halves the path on the way, so that later
    /// look-ups are short.
    fn whole(&mut self, mut region: usize) -> usize {
        while self.joined[region] != region {
            self.joined[region] = self.joined[self.joined[region]];
            region = self.joined[region];
        }
        region
    }

    fn join(&mut self, one: usize, two: usize) {
        let (one, two) = (self.whole(one), self.whole(two));
        if one != two {
            let joining = self.open[one];
            self.open[two].join(&joining);
            self.joined[one] = two;
        }
    }

    /// Removes the regions that do not reach the last row, after comparing them with the largest
    /// one, and gives the others new indices.
    fn close(&mut self) {
        let mut runs = core::mem::take(&mut self.last);
        let mut kept = Vec::new();
        // The new index of each region.
        let mut indices: Vec<Option<usize>> = Vec::new();
        indices.resize(self.open.len(), None);
        for run in &mut runs {
            let whole = self.whole(run.region);
            run.region = *indices[whole].get_or_insert_with(|| {
                kept.push(self.open[whole]);
                kept.len() - 1
            });
        }
        for (region, index) in indices.iter().enumerate() {
            if index.is_none() && self.joined[region] == region {
                self.consider(self.open[region]);
            }
        }
        self.last = runs;
        self.joined = (0..kept.len()).collect();
        self.open = kept;
    }

    fn consider(&mut self, region: LargestRegion) {
        if self
            .largest
            .is_none_or(|largest| region.is_before(&largest))
        {
            self.largest = Some(region);
        }
    }

    /// Returns the largest region, after all rows were added.
    pub fn finish(mut self) -> Option<LargestRegion> {
        for region in core::mem::take(&mut self.open) {
            self.consider(region);
        }
        self.largest
    }
}
