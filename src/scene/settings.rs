//! Settings of a picture: interpolation, culling, clipping, and hidden surfaces.

/// How attributes vary over the screen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "io", derive(serde::Serialize))]
#[cfg_attr(feature = "io", serde(rename_all = "lowercase"))]
pub enum Interpolation {
    /// Linearly on the screen, as in the lecture.
    #[default]
    Screen,
    /// Linearly in space: attributes are divided by w at the corners. A method that normalises its
    /// vectors needs no division per pixel, because the common factor cancels.
    Perspective,
}

/// Which polygons are left out because of the side from which they are seen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Culling {
    /// Leaves out polygons whose corners run clockwise on the screen.
    #[default]
    Back,
    /// Leaves out polygons whose corners run counter-clockwise on the screen.
    Front,
    /// Leaves out none.
    None,
}

/// How hidden polygons are kept out of the picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HiddenSurfaces {
    /// A depth buffer: the nearest polygon at each sample is seen (CS171 4, L5 *Z-Buffer*). The
    /// order of drawing decides only ties: the first of equally near polygons is seen, because only
    /// strictly less depth wins. Polygons with the same corners are equally near everywhere,
    /// whichever corner they begin with and whichever way they run.
    ZBuffer(DepthBuffer),
    /// The painter's algorithm: polygons are sorted from back to front once, in O(n log n), and
    /// later ones hide earlier ones (L5 *Painter's Algorithm*). No order is right for polygons that
    /// overlap in a ring or cut each other.
    Painter(PainterKey),
    /// Later polygons hide earlier ones, whatever their depth.
    DrawOrder,
}

impl Default for HiddenSurfaces {
    fn default() -> Self {
        HiddenSurfaces::ZBuffer(DepthBuffer::default())
    }
}

/// How depth is computed at a sample, and how precisely it is stored.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct DepthBuffer {
    /// The contents of a cell of the buffer.
    pub bits: DepthBits,
    /// Where the depth of a sample comes from.
    pub source: DepthSource,
}

/// The contents of a cell of the depth buffer (L5: 16 to 32 bits).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum DepthBits {
    /// The integer round(z · (2¹⁶ − 1)), halves up.
    Sixteen,
    /// The integer round(z · (2²⁴ − 1)), halves up.
    TwentyFour,
    /// An `f32` (an `f64` in the reference): z under an orthographic camera, and −1/w under
    /// perspective. −1/w has z's order, and the same relative precision at every distance
    /// ([`Vertex::depth`](crate::frame::Vertex::depth)).
    #[default]
    ThirtyTwo,
}

impl DepthBits {
    /// Returns the largest integer that is stored, 2ᵇ − 1, or `None` for floats.
    pub fn most(self) -> Option<u32> {
        match self {
            DepthBits::Sixteen => Some((1 << 16) - 1),
            DepthBits::TwentyFour => Some((1 << 24) - 1),
            DepthBits::ThirtyTwo => None,
        }
    }
}

/// How the depth of a sample is computed (L5 *Z-value Computation*). Both ways yield the same
/// values, apart from rounding.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum DepthSource {
    /// The second way: depth is computed at the corners and interpolated linearly on the screen.
    #[default]
    Interpolated,
    /// The first way: 1/w (under an orthographic camera, the distance) is interpolated, and depth
    /// is computed from it at each sample.
    PerSample,
}

/// The sorting key of the painter's algorithm.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PainterKey {
    /// The mean depth of the corners.
    #[default]
    Mean,
    /// The depth of the farthest corner.
    Farthest,
}

/// How polygons are limited to the view.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Clipping {
    /// The near and the far plane cut polygons before anything is divided by w.
    #[default]
    Planes,
    /// CS171's literal test: nothing is cut. Corners are divided by w as they are, and a sample is
    /// drawn if its interpolated position lies in the cube of normalised device coordinates (CS171
    /// 3, Algorithm 5).
    ///
    /// A polygon that crosses only the near or the far plane, in front of the eye, looks as if it
    /// were cut. A polygon that crosses the plane of the eye (w = 0) does not: a corner behind the
    /// eye is thrown to the other side of the picture. The outside of the polygon's true image is
    /// then drawn, and its inside is not. Of a ground below the eye
    /// (`tests/conformance/ndc_cube.rs`, 80 × 60) all 3,200 pixels are missing, and 400 pixels of
    /// the sky are drawn. A polygon with a corner in that plane, or so near it that its position is
    /// beyond the guard band, is left out and counted
    /// ([`FrameStats::unprojected`](crate::frame::FrameStats::unprojected)).
    NdcCube,
}
