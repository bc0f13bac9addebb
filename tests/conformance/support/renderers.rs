//! Every way in which this machine can draw a frame: the span engine, the row engine on each
//! instruction set, and threads.

use fastphong::frame::{DepthRange, Frame};
use fastphong::picture::Picture;
use fastphong::raster::Renderer;
use fastphong::reference::Visibility;
use fastphong::scene::{DepthBuffer, HiddenSurfaces};
use fastphong::shading::Variant;

/// Returns the renderers of this machine, the scalar span engine first.
pub fn renderers() -> Vec<Renderer> {
    let all: Vec<Renderer> = Renderer::available().collect();
    assert_eq!(all[0], Renderer::LECTURE);
    all
}

/// Returns the renderers that draw `frame` in different ways, the scalar span engine first. Of
/// renderers with equal plans only the first one is returned.
pub fn distinct(variant: &Variant, frame: &Frame) -> Vec<Renderer> {
    let mut plans = Vec::new();
    let mut all = renderers();
    all.retain(|&renderer| {
        let Some(drawn_by) = variant.plan(frame, renderer).renderer() else {
            return false;
        };
        let is_new = !plans.contains(&drawn_by);
        plans.push(drawn_by);
        is_new
    });
    all
}

/// Returns the name of a renderer as the command line has it.
pub fn name(renderer: Renderer) -> String {
    format!("{} on {}", renderer.engine().name(), renderer.level())
}

/// Runs `work` on `count` threads.
pub fn on_threads<T: Send>(count: usize, work: impl FnOnce() -> T + Send) -> T {
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(count)
        .build()
        .expect("a pool of threads");
    pool.install(work)
}

/// Returns true at the pixels where [`is_decided`] holds for all samples.
pub fn decided(frame: &Frame, visibility: &Visibility) -> Picture<bool> {
    let n = frame.samples();
    let mut decided = Picture::new(frame.picture_width(), frame.picture_height(), true);
    for (x, y) in (0..frame.height()).flat_map(|y| (0..frame.width()).map(move |x| (x, y))) {
        decided.row_mut(y / n)[x / n] &= is_decided(frame, visibility, x, y);
    }
    decided
}

/// True if rounding cannot change the visible polygon, because the next one is farther behind than
/// the error of depths in any engine.
pub fn is_decided(frame: &Frame, visibility: &Visibility, x: usize, y: usize) -> bool {
    // Storing moves a depth by at most half a level, in the engine and in the reference: one level
    // for each of the two surfaces.
    let levels = match frame.hidden_surfaces() {
        HiddenSurfaces::ZBuffer(DepthBuffer { bits, .. }) => {
            bits.most().map_or(0.0, |most| 2.0 / f64::from(most))
        }
        _ => 0.0,
    };
    // Under perspective 1/w is rounded, and z is f/(f − n) (1 − n/w).
    let gain = match frame.depth_range() {
        DepthRange::Perspective { near, far } => far / (far - near),
        DepthRange::Orthographic { .. } => 1.0,
    };
    visibility.depth_gap.get(x, y) > gain * depth_rounding(frame) + levels
}

/// Returns the error bound of the difference of two depths in 0..=1.
///
/// Along edges, as derived in `coverage`, each depth is rounded twice at each of width + height
/// steps, by half a unit in the last place, at most 2⁻²⁴ of 1, and 32 times at the starts of its
/// walks. By barycentric coordinates there are fewer roundings: an integer, the area, its inverse
/// and their product are rounded, 4 · 2⁻²⁴ of a coordinate in 0..=1, and so are two differences,
/// two products and two sums. A step of eight pixels is rounded once, not eight times.
pub fn depth_rounding(frame: &Frame) -> f64 {
    2.0 * (2 * (frame.width() + frame.height()) + 32) as f64 / f64::from(1 << 24)
}
