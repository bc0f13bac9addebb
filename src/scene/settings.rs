//! Settings of a picture: interpolation, culling, clipping, and the search for hidden surfaces.

/// The variation of attributes over the screen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "io", derive(serde::Serialize))]
#[cfg_attr(feature = "io", serde(rename_all = "lowercase"))]
pub enum Interpolation {
    /// Linearly on the screen, as the lecture does.
    #[default]
    Screen,
    /// Linearly in space: attributes are divided by w at the corners. A method that normalises its vectors anyway needs
    /// no division per pixel: the common factor cancels.
    Perspective,
}

/// The polygons that are left out for the direction in which they are seen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Culling {
    /// Leave out polygons whose corners run clockwise on the screen.
    #[default]
    Back,
    /// Leave out polygons whose corners run counter-clockwise on the screen.
    Front,
    /// Draw all.
    None,
}

/// The way in which hidden polygons are kept out of the picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HiddenSurfaces {
    /// The nearest polygon at each sample is seen (CS171 4, L5 *Z-Buffer*). The order of drawing decides ties only: of
    /// equally near polygons the first is seen, as strictly less depth wins. Polygons with the same corners are equally near
    /// everywhere, whichever corner each begins with and whichever way it runs.
    ZBuffer(DepthBuffer),
    /// Polygons are sorted from back to front once, in O(n log n), and later ones hide earlier ones (L5 *Painter's
    /// Algorithm*). No order is right for polygons that overlap in a ring or cut each other.
    Painter(PainterKey),
    /// Later polygons hide earlier ones, whatever their depth.
    DrawOrder,
}

impl Default for HiddenSurfaces {
    fn default() -> Self {
        HiddenSurfaces::ZBuffer(DepthBuffer::default())
    }
}

/// The making of depth at a sample, and its precision.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct DepthBuffer {
    /// The contents of a place of the buffer.
    pub bits: DepthBits,
    /// The source of depth.
    pub source: DepthSource,
}

/// The contents of a place of the depth buffer (L5: 16 to 32 bits).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum DepthBits {
    /// The whole number round(z · (2¹⁶ − 1)), halves up.
    Sixteen,
    /// The whole number round(z · (2²⁴ − 1)), halves up.
    TwentyFour,
    /// An `f32`, which the reference keeps as an `f64`: z under an orthographic camera, and −1/w under perspective, which has
    /// z's order and the same relative precision at every distance ([`Vertex::depth`](crate::frame::Vertex::depth)).
    #[default]
    ThirtyTwo,
}

impl DepthBits {
    /// Returns the largest whole number that is kept, 2ᵇ − 1; `None` for floats.
    pub fn most(self) -> Option<u32> {
        match self {
            DepthBits::Sixteen => Some((1 << 16) - 1),
            DepthBits::TwentyFour => Some((1 << 24) - 1),
            DepthBits::ThirtyTwo => None,
        }
    }
}

/// The computation of depth at a sample (L5 *Z-value Computation*): both ways give the same numbers but for rounding.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum DepthSource {
    /// The second way: depth is computed at the corners and interpolated linearly on the screen.
    #[default]
    Interpolated,
    /// The first way: what is interpolated is 1/w (orthographic: the distance), and depth is computed from it anew at
    /// each sample.
    PerSample,
}

/// By what the painter's algorithm sorts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PainterKey {
    /// The mean depth of the corners.
    #[default]
    Mean,
    /// The depth of the farthest corner.
    Farthest,
}

/// The limits of the view.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Clipping {
    /// They are cut by the near and the far plane before anything is divided by w.
    #[default]
    Planes,
    /// CS171's literal test: nothing is cut, corners are divided by w as they are, and a sample is drawn if its
    /// interpolated place lies in the cube of normalised device coordinates (CS171 3, Algorithm 5).
    ///
    /// Polygons that pass only the near or the far plane, in front of the eye, look as if they were cut. A polygon that
    /// passes the plane of the eye (w = 0) does not: a corner behind the eye is thrown to the other side of the picture,
    /// and what is drawn is the outside of the polygon's true image, its inside is not: of a ground under the eye
    /// (`tests/conformance/ndc_cube.rs`, 80 × 60) all 3,200 pixels are missing, and 400 pixels of the sky are drawn.
    /// Polygons with a corner in that plane, or so near it that its place is beyond the guard band, are left out and
    /// counted ([`FrameStats::unprojected`](crate::frame::FrameStats::unprojected)).
    NdcCube,
}
