//! How fast each row is.

use super::{Engine, Row, counterpart, is_baseline};
use crate::compare::timing::{Candidate, Limits, Ratio, Timing, time_interleaved};
use crate::frame::Frame;
use crate::picture::Picture;
use crate::raster::{Edges, Renderer};
use alloc::boxed::Box;
use alloc::vec::Vec;
use core::hint::black_box;
use serde::{Deserialize, Serialize};

/// What a [`Timing`] of a row holds, in one line.
pub const WHAT_IS_TIMED: &str = "from projected frame to stored picture: vertex lighting, rasterization, shading and \
                                 storing, with the memory they take; on as many threads as a row says; not loading, normals, \
                                 projection or triangulation";

/// The speed of a variant. A ratio over 1 means faster than what it is compared with.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Speed {
    /// Times of whole pictures: see [`WHAT_IS_TIMED`].
    pub timing: Timing,
    /// The median time divided by the pixels that any polygon covers; `None` if there are none.
    pub ns_per_covered_pixel: Option<f64>,
    /// Against naive Phong, drawn as all rows are.
    pub ratio_to_naive: Option<Ratio>,
    /// Against the barycentric renderer with the same method where it has it, naive Phong otherwise.
    pub ratio_to_barycentric: Option<Ratio>,
}

/// Times all rows together and gives each its speed.
pub(super) fn take(
    frame: &Frame,
    triangles: &Frame,
    rows: &mut [Row],
    barycentric: &mut [Row],
    covered_pixels: usize,
    (renderer, limits): (Renderer, Limits),
    progress: impl FnMut(f32),
) {
    let mut candidates: Vec<Candidate<'_>> = Vec::new();
    for row in rows.iter().chain(barycentric.iter()) {
        let variant = &row.variant;
        candidates.push(match row.engine {
            Engine::Scanlines(_) if variant.plan(frame, renderer).renderer == Renderer::Span => {
                Box::new(move || {
                    black_box(variant.render(black_box(frame)));
                })
            }
            Engine::Scanlines(_) => Box::new(move || {
                let mut picture = Picture::new(0, 0, [0; 4]);
                variant.render_with(black_box(frame), renderer, &mut picture);
                black_box(picture);
            }),
            Engine::Barycentric => Box::new(move || {
                black_box(variant.render_barycentric(black_box(triangles), Edges::TopLeft));
            }),
        });
    }
    let timings = time_interleaved(&mut candidates, limits, progress);
    drop(candidates);
    let (of_rows, of_barycentric) = timings.split_at(rows.len());
    let naive = rows
        .iter()
        .position(|row| is_baseline(&row.variant))
        .map(|i| of_rows[i].clone());
    let counterpart = |row: &Row| {
        let name = counterpart(&row.variant);
        barycentric
            .iter()
            .position(|other| other.variant.info().name == name)
            .map(|i| &of_barycentric[i])
    };
    let speed = |row: &Row, timing: &Timing| {
        let ratio = |baseline: &Timing| Ratio::paired(&baseline.samples_ns, &timing.samples_ns);
        Speed {
            timing: timing.clone(),
            ns_per_covered_pixel: (covered_pixels > 0)
                .then(|| timing.median_ns / covered_pixels as f64),
            ratio_to_naive: naive.as_ref().and_then(ratio),
            ratio_to_barycentric: counterpart(row).and_then(ratio),
        }
    };
    let both = rows
        .iter()
        .zip(of_rows)
        .chain(barycentric.iter().zip(of_barycentric));
    let speeds: Vec<Speed> = both.map(|(row, timing)| speed(row, timing)).collect();
    for (row, speed) in rows.iter_mut().chain(barycentric).zip(speeds) {
        row.speed = Some(speed);
    }
}
