//! Rendering: from a method and a frame to a picture, with the engine that a renderer asks for.

#[cfg(feature = "simd")]
use super::bands::{DrawBand, draw_bands, stream_bands};
use super::barycentric::{self, Edges};
use super::depth::SampleDepth;
use super::draw::{DrawError, DrawOptions};
use super::engine::{Plan, PolygonKind, Renderer};
use super::setup::SetUp;
use super::spans;
use super::target::{Eight, Floats, Format, Rgba, Rows, Surface, rows_of};
use crate::frame::Frame;
use crate::number::SimdLevel;
#[cfg(feature = "simd")]
use crate::picture::encoding::Encoder;
use crate::picture::encoding::store;
use crate::picture::{Encoding, LinearPicture, Picture, Picture8, PictureMut};
use crate::shading::{On, Variant};
use alloc::vec;
use alloc::vec::Vec;

impl Variant {
    /// Draws `frame` as a stored picture with the span engine. It is [`Variant::draw`] into a new
    /// picture.
    ///
    /// # Errors
    /// [`DrawError::Refused`] if the method refuses this frame, as some of
    /// [`METHODS`](crate::shading::METHODS) do.
    /// ```
    /// use fastphong::mesh::builtin::builtin;
    /// use fastphong::scene::Scene;
    /// use fastphong::shading::{METHODS, Variant};
    ///
    /// let mut scene = Scene::of_mesh(builtin("sphere")?);
    /// (scene.width, scene.height) = (64, 48);
    /// let frame = scene.frame()?;
    /// let picture = Variant::parse("gouraud")?.render(&frame)?;
    /// assert_eq!(picture.get(32, 24)[3], 255, "the sphere is in the middle");
    /// // All methods that draw the frame cover the same pixels.
    /// for method in METHODS.iter().map(|method| method.variant()) {
    ///     match method.render(&frame) {
    ///         Ok(other) => {
    ///             assert!(picture.pixels().iter().zip(other.pixels()).all(|(a, b)| a[3] == b[3]));
    ///         }
    ///         Err(error) => println!("{method}: {error}"),
    ///     }
    /// }
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn render(&self, frame: &Frame) -> Result<Picture8, DrawError> {
        self.render_with(frame, Renderer::LECTURE)
    }

    /// Draws `frame` as [`Variant::render`] does, but before rounding: channels are linear, in
    /// 0..=1.
    ///
    /// # Errors
    /// As [`Variant::render`].
    pub fn render_linear(&self, frame: &Frame) -> Result<LinearPicture, DrawError> {
        self.render_linear_with(frame, Renderer::LECTURE)
    }

    /// Draws as [`Variant::render`] with another renderer.
    ///
    /// # Errors
    /// As [`Variant::render`].
    pub fn render_with(&self, frame: &Frame, renderer: Renderer) -> Result<Picture8, DrawError> {
        self.render_anew(frame, renderer, [0; 4])
    }

    /// Draws as [`Variant::render_linear`] with another renderer.
    ///
    /// # Errors
    /// As [`Variant::render`].
    pub fn render_linear_with(
        &self,
        frame: &Frame,
        renderer: Renderer,
    ) -> Result<LinearPicture, DrawError> {
        self.render_anew(frame, renderer, [0.0; 4])
    }

    /// Draws into a new picture.
    fn render_anew<T: Copy>(
        &self,
        frame: &Frame,
        renderer: Renderer,
        zero: T,
    ) -> Result<Picture<T>, DrawError>
    where
        for<'a> &'a mut Picture<T>: Into<PictureMut<'a>>,
    {
        // Every pixel is drawn or becomes background, so the initial value is never seen. Zeroed
        // memory stays untouched until the threads that draw write to it, each in its own rows.
        let mut picture = Picture::new(frame.picture_width(), frame.picture_height(), zero);
        self.draw(frame, &mut picture, DrawOptions::by(renderer))?;
        Ok(picture)
    }

    /// Says which renderer draws `frame` with this method if `renderer` is asked for. Where the row
    /// engine cannot draw it, the span engine does, with a reason. Where the method refuses the
    /// frame, none does.
    pub fn plan(&self, frame: &Frame, renderer: Renderer) -> Plan {
        if let Some(reason) = self.row().refuses(On::Frame(frame)) {
            return Plan::Refused(reason);
        }
        let depth = SampleDepth::new(frame);
        let reason = match renderer {
            Renderer::Row(level) if level == SimdLevel::Scalar || !level.is_available() => {
                Some("the row engine needs SIMD instructions that this machine does not have")
            }
            Renderer::Row(_) if self.row().scalar_only().is_some() => self.row().scalar_only(),
            Renderer::Row(_) if !depth.is_interpolated() => {
                Some("the row engine interpolates depth and does not compute it per sample")
            }
            Renderer::Row(_) if depth.cube.is_some() => {
                Some("the row engine does not test samples against the NDC cube")
            }
            // The G-buffer holds the index of the uniforms as a float, which is exact below 2²⁴.
            Renderer::Row(_) if frame.polygons().len() >= 1 << 24 => {
                Some("the row engine takes less than 2^24 polygons")
            }
            _ => None,
        };
        match reason {
            Some(reason) => Plan::Instead {
                renderer: Renderer::Span,
                reason,
            },
            None => Plan::AsAsked(renderer),
        }
    }

    /// Returns how many polygons of `frame` the method draws by each of its kinds
    /// ([`crate::shading::Method::Kinds`]), in their order. Empty for methods that treat all
    /// polygons alike.
    pub fn polygon_kinds(&self, frame: &Frame) -> Vec<PolygonKind> {
        let names = self.row().kinds();
        if names.is_empty() {
            return Vec::new();
        }
        let of_polygons = self.kinds_of_polygons(frame);
        let count = |kind: usize| {
            let same = of_polygons.iter().filter(|k| usize::from(**k) == kind);
            same.count()
        };
        let kinds = names.iter().enumerate();
        kinds
            .map(|(kind, name)| PolygonKind {
                name,
                polygons: count(kind),
            })
            .collect()
    }

    /// Returns the kind by which the method draws each polygon, an index into
    /// [`crate::shading::Method::Kinds`].
    pub fn kinds_of_polygons(&self, frame: &Frame) -> Vec<u8> {
        let setup = SetUp::new(self, frame, SimdLevel::Scalar, 1.0, Vec::new());
        match setup.kinds() {
            // Either the method has no kinds, or another method stands in for it, which is as exact
            // as the first kind.
            [] => vec![0; frame.polygons().len()],
            kinds => kinds.to_vec(),
        }
    }

    /// Draws rows of a frame's picture.
    pub(super) fn draw_rows<F: Format>(
        &self,
        renderer: Renderer,
        surface: Surface<'_, F>,
        mut rows: Rows<'_, F::Pixel>,
    ) {
        let frame = surface.frame;
        #[cfg(feature = "simd")]
        if let Renderer::Row(level) = renderer {
            let (is_levels, has_depth) = (surface.format.is_levels(), rows.depth.is_some());
            // The closure is called once, which its type does not say.
            let mut rows = Some(rows);
            let each_band = &mut |height: usize, draw: &DrawBand<'_>| {
                if let Some(rows) = rows.take() {
                    draw_bands(surface, height, 0, rows, draw);
                }
            };
            return super::rows::draw(self, frame, level, is_levels, has_depth, each_band);
        }
        let _ = renderer; // without SIMD there is one engine
        surface.clear(&mut rows);
        let setup = SetUp::new(self, frame, SimdLevel::Scalar, 1.0, Vec::new());
        surface.draw_rows(rows, |target| spans::draw(&setup, target));
    }

    /// Draws `frame` as a stored picture and passes its pixels to `take` from the top, some rows at
    /// a time, soon after they are drawn. Use it for files larger than memory: only the span engine
    /// keeps the whole picture in memory.
    ///
    /// # Errors
    /// [`DrawError::Refused`], before anything is drawn, if the method refuses the frame. The inner
    /// result is the first error of `take`, after which nothing more is drawn.
    ///
    /// ```
    /// use core::convert::Infallible;
    /// use fastphong::mesh::builtin::builtin;
    /// use fastphong::raster::Renderer;
    /// use fastphong::scene::Scene;
    /// use fastphong::shading::Variant;
    ///
    /// let frame = Scene::of_mesh(builtin("sphere")?).frame()?;
    /// let mut pixels = 0;
    /// Variant::parse("phong-rsqrt")?.render_rows(&frame, Renderer::fastest(), |rows| {
    ///     pixels += rows.len();
    ///     Ok::<(), Infallible>(())
    /// })??;
    /// assert_eq!(pixels, frame.picture_width() * frame.picture_height());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn render_rows<E>(
        &self,
        frame: &Frame,
        renderer: Renderer,
        mut take: impl FnMut(&[[u8; 4]]) -> Result<(), E>,
    ) -> Result<Result<(), E>, DrawError> {
        let plan = self.plan(frame, renderer);
        #[cfg(feature = "simd")]
        if let Some(Renderer::Row(level)) = plan.renderer() {
            let encoder = (frame.encoding() == Encoding::Srgb).then(Encoder::srgb);
            let surface = Surface::new(frame, Eight::<Rgba>::new(encoder));
            let is_levels = surface.format.is_levels();
            let mut taken = Ok(());
            let each_band = &mut |height: usize, draw: &DrawBand<'_>| {
                let mut take = |pixels: &[[u8; 4]]| {
                    taken = take(pixels);
                    taken.is_ok()
                };
                stream_bands(surface, height, &mut take, draw);
            };
            super::rows::draw(self, frame, level, is_levels, false, each_band);
            return Ok(taken);
        }
        match plan {
            Plan::Refused(reason) => Err(DrawError::Refused(reason)),
            _ => Ok(take(self.render(frame)?.pixels())),
        }
    }

    /// Draws the triangles of `frame` with the barycentric renderer. Returns `None` if that
    /// renderer does not have this method.
    pub fn render_barycentric(&self, frame: &Frame, edges: Edges) -> Option<Picture8> {
        match frame.encoding() {
            Encoding::Linear => {
                self.triangles(Surface::new(frame, Eight::<Rgba>::new(None)), edges, [0; 4])
            }
            encoding => Some(store(
                &self.render_barycentric_linear(frame, edges)?,
                encoding,
            )),
        }
    }

    /// Draws as [`Variant::render_barycentric`], but before rounding.
    pub fn render_barycentric_linear(&self, frame: &Frame, edges: Edges) -> Option<LinearPicture> {
        self.triangles(Surface::new(frame, Floats), edges, [0.0; 4])
    }

    /// Draws a frame's triangles over an empty picture.
    fn triangles<F: Format>(
        &self,
        surface: Surface<'_, F>,
        edges: Edges,
        zero: F::Pixel,
    ) -> Option<Picture<F::Pixel>> {
        if !self.row().is_barycentric() {
            return None;
        }
        let frame = surface.frame;
        let mut picture = Picture::new(frame.picture_width(), frame.picture_height(), zero);
        surface.clear(&mut rows_of(frame, &mut picture));
        let setup = SetUp::new(self, frame, SimdLevel::Scalar, 1.0, Vec::new());
        surface.draw_anyhow(rows_of(frame, &mut picture), |target| {
            barycentric::draw(&setup, edges, target);
        });
        Some(picture)
    }
}
