//! Drawing into what the caller owns: the options, and what cannot be drawn.

use super::depth::DepthTest;
use super::engine::Renderer;
use super::target::{Argb, Bgra, Eight, Floats, Format, Rgba, Rows, Surface};
use crate::frame::Frame;
use crate::picture::encoding::Encoder;
use crate::picture::{Encoding, PictureMut, PixelsMut};
use crate::scene::{DepthBits, HiddenSurfaces};
use crate::shading::Variant;
use core::fmt;

/// What [`Variant::draw`] does with pixels that no polygon covers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Background {
    /// They become the frame's background, with alpha 0.
    #[default]
    Drawn,
    /// They stay as they are, and the frame is drawn over the picture. Of several samples a pixel the covered share lies over what
    /// was there, in linear light.
    Kept,
}

/// How [`Variant::draw`] draws. `DrawOptions::default()` is the lecture's engine over the frame's background.
///
/// There is no viewport and no scissor among them: [`Variant::draw`] says what to do in their place.
#[derive(Debug, Default)]
pub struct DrawOptions<'a> {
    /// The engine and instruction set: [`Renderer::fastest`], or the default, whose bits are the same on every machine.
    pub renderer: Renderer,
    /// What becomes of pixels that nothing covers.
    pub background: Background,
    /// A depth buffer of the caller's: [`Frame::width`] × [`Frame::height`] values, one a sample, row by row from the top. They are
    /// depths as [`Vertex::depth`](crate::frame::Vertex::depth) is: −1/w under perspective, else from 0 to 1; infinite where there is
    /// nothing yet. A sample is drawn where its depth passes [`DrawOptions::depth_test`] against the value, which then becomes its
    /// depth: so several frames share a picture, and your own rasterizer may draw between them. Wants a frame with a depth
    /// buffer of 32 bits.
    pub depth: Option<&'a mut [f32]>,
    /// The comparison with [`DrawOptions::depth`], and whether that buffer is reversed. Within a frame the nearest polygon hides
    /// the others in any case.
    pub depth_test: DepthTest,
}

impl DrawOptions<'_> {
    /// Returns the options of drawing by `renderer`, over the frame's background.
    pub fn by(renderer: Renderer) -> Self {
        DrawOptions {
            renderer,
            ..DrawOptions::default()
        }
    }
}

/// The reason why a frame could not be drawn; nothing was written then.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DrawError {
    /// The picture has another size than the frame's picture.
    Size {
        /// Width and height of the picture.
        found: [usize; 2],
        /// Width and height that the frame asks for.
        expected: [usize; 2],
    },
    /// Rows of the picture are nearer to each other than they are long.
    Stride {
        /// The distance of rows, in pixels.
        stride: usize,
        /// The pixels of a row.
        width: usize,
    },
    /// The picture was given fewer pixels than its rows take.
    Pixels {
        /// The number of pixels.
        found: usize,
        /// The least number.
        expected: usize,
    },
    /// The depth buffer has not one number for each sample.
    Depth {
        /// The numbers in it.
        found: usize,
        /// The samples of the frame.
        expected: usize,
    },
    /// A depth buffer was given for a frame that is drawn without one: by the painter's algorithm, or in order.
    DepthNotTested,
    /// A depth buffer was given for a frame whose own is rounded to so many bits.
    DepthRounded(DepthBits),
    /// The method is not for such frames, with the reason: see [`Shader::on`](crate::shading::Shader::on).
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
                "the depth buffer has {found} numbers: the frame has {expected} samples"
            ),
            DrawError::DepthNotTested => f.write_str(
                "the frame is drawn in order, without a depth test: leave the depth buffer out, or give the frame one",
            ),
            DrawError::DepthRounded(bits) => write!(
                f,
                "the frame rounds depth to {} bits: give it a depth buffer of 32",
                bits.most().map_or(32, u32::count_ones)
            ),
            DrawError::Refused(reason) => write!(f, "the method is not for this frame: {reason}"),
        }
    }
}

impl core::error::Error for DrawError {}

/// Returns why `picture` and the depth buffer of `options` are not those of `frame`, if they are not.
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
    // The last row need not be followed by what lies between two. No memory has as many pixels as do not fit.
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
    /// Draws `frame` into a picture that the caller owns, and returns the renderer that drew: the one of `options`, or the span
    /// engine where [`Variant::plan`] says so. Eight bits a channel are encoded as the frame asks, floats are linear.
    ///
    /// Two frames of one size, drawn one after the other with one depth buffer, make the picture of both:
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
    ///     let depth = Some(&mut depth[..]);
    ///     method.draw(frame, picture, DrawOptions { background, depth, ..Default::default() })?;
    /// }
    /// assert_eq!(window[80 * 24 + 32] >> 24, 255, "something is in the middle");
    /// assert!(depth[64 * 24 + 32] < 1.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # A viewport, a scissor, a stencil
    ///
    /// A frame always fills the picture that it is given, and nothing beyond it is written:
    ///
    /// - **Viewport**: give it a part of the picture, [`PictureMut::part`], and a frame of that size.
    /// - **Scissor**: polygons are cut off at the edges of their frame, exactly. So a scissor rectangle is a frame of its size, whose
    ///   vertices are moved by its corner (of a [`FrameBuilder`](crate::frame::FrameBuilder), by whole pixels), in that part of
    ///   the picture.
    /// - **Stencil**, of any shape, and a scissor for scenes: a depth buffer that holds −∞ where nothing is to be drawn (+∞ if
    ///   it is reversed), with [`Background::Kept`].
    ///
    /// # Errors
    /// [`DrawError`] where picture, depth buffer and frame do not go together, or the method is not for the frame.
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

/// A frame to be drawn into some pixels: all that does not depend on their format.
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
