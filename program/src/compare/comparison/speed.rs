//! Times all rows of a comparison.

use super::{Comparison, MethodRow, counterpart, is_baseline};
use crate::compare::timing::{Candidate, Ratio, TimeLimits, Timing, time_interleaved};
use alloc::boxed::Box;
use alloc::vec::Vec;
use core::hint::black_box;
use fastphong::frame::Frame;
use fastphong::raster::Edges;
use serde::Serialize;

/// The definition of a row's [`Timing`], in one line.
pub const WHAT_IS_TIMED: &str = "from projected frame to stored picture: vertex lighting, rasterization, shading and \
                                 storing, with the memory they take; on as many threads as a row says; not loading, normals, \
                                 projection or triangulation";

/// The speed of a variant. A ratio over 1 means that the variant is faster.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Speed {
    /// Times of whole pictures: see [`WHAT_IS_TIMED`].
    pub timing: Timing,
    /// The median time divided by the pixels that any polygon covers; `None` if there are none.
    pub ns_per_covered_pixel: Option<f64>,
    /// The ratio to naive Phong, drawn by the same renderer.
    pub ratio_to_naive: Option<Ratio>,
    /// The ratio to the barycentric renderer with the same method, or with naive Phong if it does
    /// not have the method.
    pub ratio_to_barycentric: Option<Ratio>,
}

/// Times all rows together and sets their speeds.
pub(super) fn time(
    comparison: &mut Comparison,
    frame: &Frame,
    triangles: &Frame,
    limits: TimeLimits,
    progress: impl FnMut(f32),
) {
    let renderer = comparison.requested;
    let mut candidates: Vec<Candidate<'_>> = Vec::new();
    for MethodRow { variant, .. } in &comparison.rows {
        candidates.push(Box::new(move || {
            let _ = black_box(variant.render_with(black_box(frame), renderer));
        }));
    }
    for MethodRow { variant, .. } in &comparison.barycentric {
        candidates.push(Box::new(move || {
            black_box(variant.render_barycentric(black_box(triangles), Edges::TopLeft));
        }));
    }
    // All candidates share their rounds, so that any two rows can be compared round by round.
    let timings = time_interleaved(&mut candidates, limits, progress);
    drop(candidates);
    let (of_rows, of_barycentric) = timings.split_at(comparison.rows.len());
    let (rows, barycentric) = (&comparison.rows, &comparison.barycentric);
    let naive = rows
        .iter()
        .position(|row| is_baseline(&row.variant))
        .map(|i| &of_rows[i]);
    let other = |row: &MethodRow| {
        let name = counterpart(&row.variant);
        let is_it = |other: &MethodRow| other.variant.info().name == name;
        Some(&of_barycentric[barycentric.iter().position(is_it)?])
    };
    let pixels = comparison.covered_pixels;
    let speed = |(row, timing): (&MethodRow, &Timing)| {
        let ratio = |to: &Timing| Ratio::paired(&to.samples_ns, &timing.samples_ns);
        Speed {
            timing: timing.clone(),
            ns_per_covered_pixel: (pixels > 0).then(|| timing.median_ns / pixels as f64),
            ratio_to_naive: naive.and_then(ratio),
            ratio_to_barycentric: other(row).and_then(ratio),
        }
    };
    let speeds: Vec<Speed> = comparison.all_rows().zip(&timings).map(speed).collect();
    let rows = comparison.rows.iter_mut();
    for (row, speed) in rows.chain(&mut comparison.barycentric).zip(speeds) {
        row.speed = Some(speed);
    }
}
