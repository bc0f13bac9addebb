//! Drawing into memory that the caller owns: the options, and the reasons why a frame cannot be
//! drawn.

use super::depth::DepthTest;
use super::engine::{Engine, Renderer};
#[cfg(feature = "simd")]
use super::second_pass;
use super::target::{Argb, Bgra, Eight, Floats, Format, Rgba, Rows, Surface};
use crate::frame::Frame;
use crate::picture::encoding::Encoder;
use crate::picture::{Encoding, PictureMut, PixelsMut};
use crate::scene::{DepthBits, HiddenSurfaces};
use crate::shading::Variant;
use core::fmt;

/// The treatment of pixels that no polygon covers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Background {
    /// They become the frame's background, with alpha 0.
    #[default]
    Drawn,
    /// They keep their colour: the frame is drawn over the picture. With several samples per pixel,
    /// the covered share is blended over the old colour in linear light.
    Kept,
}

/// The options of [`Variant::draw`]. `DrawOptions::default()` draws with the span engine over the
/// frame's background. Start from it or from [`DrawOptions::by`], and set the rest:
///
/// ```
/// use fastphong::raster::{Background, DrawOptions, Renderer};
///
/// let mut depth = vec![f32::INFINITY; 64 * 48];
/// let options = DrawOptions::by(Renderer::fastest())
///     .background(Background::Kept)
///     .depth(&mut depth);
/// ```
///
/// There is no viewport and no scissor here: [`Variant::draw`] says what to do instead.
#[derive(Debug, Default)]
#[non_exhaustive]
pub struct DrawOptions<'a> {
    /// The engine and its instruction set. The default draws the same bits on every machine;
    /// [`Renderer::fastest`] is faster.
    pub renderer: Renderer,
    /// What happens to pixels that no polygon covers.
    pub background: Background,
    /// Your depth buffer, if there is one: [`Frame::width`] × [`Frame::height`] values, one per
    /// sample, row by row from the top.
    ///
    /// Values are depths as in [`Vertex::depth`](crate::frame::Vertex::depth): −1/w under
    /// perspective, else from 0 to 1; infinite where nothing is drawn yet. A sample is drawn if its
    /// depth passes [`depth_test`](field@DrawOptions::depth_test) against the value, and the value
    /// then becomes its depth. So several frames can share a picture, and your own rasterizer can
    /// draw between them. The frame must have a depth buffer of 32 bits.
    pub depth: Option<&'a mut [f32]>,
    /// How samples are compared with [`depth`](field@DrawOptions::depth), and if that buffer is
    /// reversed. Within a frame the nearest polygon always hides the others.
    pub depth_test: DepthTest,
}

impl<'a> DrawOptions<'a> {
    /// Returns options that draw with `renderer`, over the frame's background.
    pub fn by(renderer: Renderer) -> Self {
        DrawOptions {
            renderer,
            ..DrawOptions::default()
        }
    }

    /// Sets what happens to pixels that no polygon covers.
    pub fn background(mut self, background: Background) -> Self {
        self.background = background;
        self
    }

    /// Sets your depth buffer. See [`DrawOptions::depth`](field@DrawOptions::depth).
    pub fn depth(mut self, depth: &'a mut [f32]) -> Self {
        self.depth = Some(depth);
        self
    }

    /// Sets how samples are compared with your depth buffer.
    pub fn depth_test(mut self, test: DepthTest) -> Self {
        self.depth_test = test;
        self
    }
}

/// The reason why a frame was not drawn. Nothing has been written then.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum DrawError {
    /// The picture does not have the size of the frame's picture.
    Size {
        /// Width and height of the picture.
        found: [usize; 2],
        /// Width and height that the frame needs.
        expected: [usize; 2],
    },
    /// The stride of the picture is shorter than its rows.
    Stride {
        /// The distance from one row to the next, in pixels.
        stride: usize,
        /// The length of a row, in pixels.
        width: usize,
    },
    /// The picture's memory is too small for its rows.
    Pixels {
        /// How many pixels there is memory for.
        found: usize,
        /// How many pixels the rows need.
        expected: usize,
    },
    /// The depth buffer does not have one value for each sample.
    Depth {
        /// How many values it has.
        found: usize,
        /// How many samples the frame has.
        expected: usize,
    },
    /// A depth buffer was passed for a frame that is drawn without one: by the painter's algorithm,
    /// or in order.
    DepthNotTested,
    /// A depth buffer was passed for a frame that rounds depth to fewer than 32 bits. Holds the
    /// frame's bits.
    DepthRounded(DepthBits),
    /// The test is for equal depths, but the depth buffer holds what another engine found for the
    /// frame's polygons, and engines round depths otherwise. Holds that engine.
    DepthOfEngine(Engine),
    /// The method refuses this frame: see [`Shader::on`](crate::shading::Shader::on). Holds the
    /// reason.
    Refused(&'static str),
}

impl fmt::Display for DrawError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            DrawError::Size {
                found: [width, height],
                expected: [w, h],
            } => write!(
                f,
                "the picture is {width}x{height}: the frame draws {w}x{h} pixels"
            ),
            DrawError::Stride { stride, width } => write!(
                f,
                "a stride of {stride} pixels is shorter than a row of {width}"
            ),
            DrawError::Pixels { found, expected } => write!(
                f,
                "the picture has memory for {found} pixels: its rows take {expected}"
            ),
            DrawError::Depth { found, expected } => write!(
                f,
                "the depth buffer has {found} values: the frame has {expected} samples"
            ),
            DrawError::DepthNotTested => f.write_str(
                "the frame is drawn in order, without a depth test: leave the depth buffer out, or give the frame one",
            ),
            DrawError::DepthRounded(bits) => write!(
                f,
                "the frame rounds depth to {} bits: give it a depth buffer of 32",
                bits.most().map_or(32, u32::count_ones)
            ),
            DrawError::DepthOfEngine(engine) => write!(
                f,
                "the depth buffer holds the frame's depths from the {} engine, which rounds them otherwise: draw all passes with one engine, or test for less or greater",
                engine.name()
            ),
            DrawError::Refused(reason) => write!(f, "the method is not for this frame: {reason}"),
        }
    }
}

impl core::error::Error for DrawError {}

/// Checks that `picture` and the caller's depth buffer fit `frame`.
fn check(frame: &Frame, picture: &PictureMut<'_>, depth: Option<&[f32]>) -> Result<(), DrawError> {
    let &PictureMut {
        width,
        height,
        stride,
        ..
    } = picture;
    let expected = [frame.picture_width(), frame.picture_height()];
    if [width, height] != expected {
        let found = [width, height];
        return Err(DrawError::Size { found, expected });
    }
    if stride < width {
        return Err(DrawError::Stride { stride, width });
    }
    // The last row may end with its last pixel, without the gap that separates two rows. The
    // product saturates: no memory holds that many pixels.
    let expected = stride.saturating_mul(height - 1).saturating_add(width);
    let found = picture.len();
    if found < expected {
        return Err(DrawError::Pixels { found, expected });
    }
    let Some(depth) = depth else {
        return Ok(());
    };
    let (found, expected) = (depth.len(), frame.width() * frame.height());
    if found != expected {
        return Err(DrawError::Depth { found, expected });
    }
    match frame.hidden_surfaces() {
        HiddenSurfaces::ZBuffer(buffer) if buffer.bits.most().is_some() => {
            Err(DrawError::DepthRounded(buffer.bits))
        }
        HiddenSurfaces::ZBuffer(_) => Ok(()),
        HiddenSurfaces::Painter(_) | HiddenSurfaces::DrawOrder => Err(DrawError::DepthNotTested),
    }
}

impl Variant {
    /// Draws `frame` into a picture that the caller owns. Returns the renderer that drew: the one
    /// of `options`, or the span engine where [`Variant::plan`] says so. Pictures with eight bits
    /// per channel are encoded as the frame asks; floats stay linear.
    ///
    /// Two frames of one size, drawn one after the other with one depth buffer, make one picture of
    /// both:
    ///
    /// ```
    /// use fastphong::glam::{DAffine3, DVec3};
    /// use fastphong::mesh::builtin::builtin;
    /// use fastphong::picture::PictureMut;
    /// use fastphong::raster::{Background, DrawOptions};
    /// use fastphong::scene::Scene;
    /// use fastphong::shading::Variant;
    ///
    /// let mut scene = Scene::of_mesh(builtin("torus")?);
    /// (scene.width, scene.height) = (64, 48);
    /// let torus = scene.frame()?;
    /// scene.objects[0].mesh = builtin("sphere")?.into();
    /// scene.objects[0].transform = DAffine3::from_scale(DVec3::splat(0.5));
    /// let sphere = scene.frame()?;
    ///
    /// let mut window = vec![0u32; 80 * 48]; // 0xAARRGGBB, rows 80 pixels apart
    /// let mut depth = vec![f32::INFINITY; 64 * 48];
    /// let method = Variant::parse("phong-rsqrt")?;
    /// for (frame, background) in [(&torus, Background::Drawn), (&sphere, Background::Kept)] {
    ///     let picture = PictureMut::argb(&mut window, 64, 48).stride(80);
    ///     let options = DrawOptions::default().background(background).depth(&mut depth);
    ///     method.draw(frame, picture, options)?;
    /// }
    /// assert_eq!(window[80 * 24 + 32] >> 24, 255, "something is in the middle");
    /// assert!(depth[64 * 24 + 32] < 1.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # A viewport, a scissor, a stencil
    ///
    /// A frame always fills the whole picture that it is drawn into, and nothing beyond it is
    /// written:
    ///
    /// - **Viewport**: pass a part of the picture, [`PictureMut::part`], and a frame of that size.
    /// - **Scissor**: polygons are cut off exactly at the edges of their frame. So a scissor
    ///   rectangle is a frame of its size, drawn into that part of the picture. Move the vertices
    ///   by the rectangle's corner (in a [`FrameBuilder`](crate::frame::FrameBuilder), by whole
    ///   pixels).
    /// - **Stencil** of any shape, or a scissor for scenes: pass a depth buffer that holds −∞ where
    ///   nothing shall be drawn (+∞ if it is reversed), with [`Background::Kept`].
    ///
    /// # Errors
    /// [`DrawError`] if picture, depth buffer and frame do not fit together, the method refuses the
    /// frame, or a test for equal depths meets depths of another engine.
    pub fn draw<'p>(
        &self,
        frame: &Frame,
        picture: impl Into<PictureMut<'p>>,
        options: DrawOptions<'_>,
    ) -> Result<Renderer, DrawError> {
        let picture = picture.into();
        check(frame, &picture, options.depth.as_deref())?;
        let plan = self.plan(frame, options.renderer);
        let refused = || DrawError::Refused(plan.reason().unwrap_or_default());
        let renderer = plan.renderer().ok_or_else(refused)?;
        #[cfg(feature = "simd")]
        if let Some(stored) = options.depth.as_deref() {
            let other = second_pass::other_engine(frame, renderer, options.depth_test, stored);
            if let Some(engine) = other {
                return Err(DrawError::DepthOfEngine(engine));
            }
        }
        let encoder = (frame.encoding() == Encoding::Srgb).then(Encoder::srgb);
        let drawing = Drawing {
            variant: self,
            frame,
            renderer,
            keeps_background: options.background == Background::Kept,
            stride: picture.stride,
            depth: options.depth,
            test: options.depth_test,
        };
        match picture.pixels {
            PixelsMut::Rgba8(pixels) => drawing.into(Eight::<Rgba>::new(encoder), pixels),
            PixelsMut::Bgra8(pixels) => drawing.into(Eight::<Bgra>::new(encoder), pixels),
            PixelsMut::Argb(pixels) => drawing.into(Eight::<Argb>::new(encoder), pixels),
            PixelsMut::Linear(pixels) => drawing.into(Floats, pixels),
        }
        Ok(renderer)
    }
}

/// The job of drawing a frame, without anything that depends on the pixel format.
struct Drawing<'a> {
    variant: &'a Variant,
    frame: &'a Frame,
    renderer: Renderer,
    keeps_background: bool,
    stride: usize,
    depth: Option<&'a mut [f32]>,
    test: DepthTest,
}

impl Drawing<'_> {
    fn into<F: Format>(self, format: F, pixels: &mut [F::Pixel]) {
        let frame = self.frame;
        let surface = Surface {
            frame,
            format,
            keeps_background: self.keeps_background,
        };
        let rows = Rows {
            pixels,
            stride: self.stride,
            count: frame.picture_height(),
            depth: self.depth,
            test: self.test,
            samples: frame.width() * frame.samples(),
        };
        self.variant.draw_rows(self.renderer, surface, rows);
    }
}
