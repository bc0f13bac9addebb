//! Times all rows of a comparison.

use super::{Comparison, MethodRow, counterpart, is_baseline};
use crate::compare::timing::{Candidate, Clock, Ratio, TimeLimits, Timing, time_interleaved};
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
    /// The typical time divided by the pixels that any polygon covers; `None` if there are none.
    pub ns_per_covered_pixel: Option<f64>,
    /// The ratio to naive Phong, drawn by the same renderer.
    pub ratio_to_naive: Option<Ratio>,
    /// The ratio to the barycentric renderer with the same method, or with naive Phong if it does
    /// not have the method.
    pub ratio_to_barycentric: Option<Ratio>,
    /// On several threads, the ratio of the processors' times to naive Phong: the work of all
    /// threads, which says nothing about how soon it is done.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub work_to_naive: Option<Ratio>,
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
    let rows = &comparison.rows;
    let naive = rows.iter().position(|row| is_baseline(&row.variant));
    let to_naive = |candidate: usize| Some((naive?, candidate));
    let to_barycentric = |candidate: usize, row: &MethodRow| {
        let name = counterpart(&row.variant);
        let mut others = comparison.barycentric.iter();
        let place = others.position(|other| other.variant.info().name == name)?;
        Some((rows.len() + place, candidate))
    };
    let all = || comparison.all_rows().enumerate();
    let ratios = all().flat_map(|(i, row)| [to_naive(i), to_barycentric(i, row)]);
    let ratios: Vec<(usize, usize)> = ratios.flatten().collect();
    // All candidates share their rounds, so that any two rows can be compared.
    let clock = Clock::new(renderer.threads());
    let times = time_interleaved(clock, &mut candidates, &ratios, limits, progress);
    let work = (times.clock().threads() > 1).then(|| times.of_work());
    let pixels = comparison.covered_pixels;
    let speed = |(i, row): (usize, &MethodRow)| {
        let timing = times.timing(i);
        let ratio = |of: Option<(usize, usize)>| times.ratio(of?.0, of?.1);
        Speed {
            ns_per_covered_pixel: (pixels > 0).then(|| timing.typical_ns / pixels as f64),
            timing,
            ratio_to_naive: ratio(to_naive(i)),
            ratio_to_barycentric: ratio(to_barycentric(i, row)),
            work_to_naive: work.as_ref().and_then(|work| work.ratio(naive?, i)),
        }
    };
    let speeds: Vec<Speed> = all().map(speed).collect();
    comparison.noise = Some(times.noise(&ratios));
    drop(candidates);
    let rows = comparison.rows.iter_mut();
    for (row, speed) in rows.chain(&mut comparison.barycentric).zip(speeds) {
        row.speed = Some(speed);
    }
}
