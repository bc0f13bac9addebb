//! Rendering: from a method and a frame to a picture, by the engine that a renderer asks for.

#[cfg(feature = "simd")]
use super::bands::{draw_bands, stream_bands};
use super::barycentric::{self, Edges};
use super::depth::SampleDepth;
use super::engine::{Plan, PolygonKind, Renderer};
use super::setup::SetUp;
use super::spans;
use super::target::{Stored, draw_anyhow, draw_rows, empty};
use crate::frame::Frame;
use crate::number::Level;
use crate::picture::encoding::store;
use crate::picture::{Encoding, LinearPicture, Picture, Picture8};
use crate::shading::Variant;
use alloc::vec::Vec;

impl Variant {
    /// Draws `frame` as a stored picture, by the span engine.
    ///
    /// ```
    /// use fastphong::mesh::builtin::builtin;
    /// use fastphong::scene::Scene;
    /// use fastphong::shading::{METHODS, Variant};
    ///
    /// let mut scene = Scene::of_mesh(builtin("sphere")?);
    /// (scene.width, scene.height) = (64, 48);
    /// let frame = scene.frame()?;
    /// let picture = Variant::parse("gouraud")?.render(&frame);
    /// assert_eq!(picture.get(32, 24)[3], 255, "the sphere is in the middle");
    /// // Every method covers the same pixels.
    /// for method in METHODS {
    ///     let other = method.variant().render(&frame);
    ///     assert!(picture.pixels().iter().zip(other.pixels()).all(|(a, b)| a[3] == b[3]));
    /// }
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn render(&self, frame: &Frame) -> Picture8 {
        let mut picture = Picture8::new(0, 0, [0; 4]);
        self.render_into(frame, &mut picture);
        picture
    }

    /// Draws `frame` into `picture`, which is made anew unless it has the size of the frame's picture: for drawing many frames
    /// without asking for memory each time.
    pub fn render_into(&self, frame: &Frame, picture: &mut Picture8) {
        self.render_with(frame, Renderer::LECTURE, picture);
    }

    /// Draws `frame` before rounding: linear channels, clamped to 0..=1.
    pub fn render_linear(&self, frame: &Frame) -> LinearPicture {
        self.render_linear_with(frame, Renderer::LECTURE)
    }

    /// Returns the renderer that draws `frame` with this method where `renderer` is asked for: the span engine, with a reason,
    /// if the row engine cannot draw it; none if the method is not for such frames.
    pub fn plan(&self, frame: &Frame, renderer: Renderer) -> Plan {
        if let Some(reason) = (self.entry().refuses)(frame) {
            return Plan::Refused(reason);
        }
        let depth = SampleDepth::new(frame);
        let reason = match renderer {
            Renderer::Row(level) if level == Level::Scalar || !level.is_available() => {
                Some("the row engine needs SIMD instructions that this machine does not have")
            }
            Renderer::Row(_) if self.entry().scalar_only().is_some() => self.entry().scalar_only(),
            Renderer::Row(_) if !depth.is_interpolated() => {
                Some("the row engine interpolates depth and does not compute it per sample")
            }
            Renderer::Row(_) if depth.cube => {
                Some("the row engine does not test samples against the NDC cube")
            }
            // The number of a material is a float in the G-buffer.
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

    /// Returns how many polygons of `frame` the method draws by each of its kinds ([`crate::shading::Shader::KINDS`]), in their order;
    /// nothing for methods that do not tell polygons apart.
    pub fn polygon_kinds(&self, frame: &Frame) -> Vec<PolygonKind> {
        let names = self.entry().kinds();
        if names.is_empty() {
            return Vec::new();
        }
        let setup = SetUp::new(self, frame, (Level::Scalar, 1.0, Vec::new()));
        let count = |kind: usize| {
            setup
                .kinds()
                .iter()
                .filter(|k| usize::from(**k) == kind)
                .count()
        };
        let kinds = names.iter().enumerate();
        kinds
            .map(|(kind, name)| PolygonKind {
                name,
                polygons: count(kind),
            })
            .collect()
    }

    /// Draws `frame` with an engine and an instruction set into `picture`, which is made anew unless it has the size of the
    /// frame's picture.
    pub fn render_with(&self, frame: &Frame, renderer: Renderer, picture: &mut Picture8) {
        if frame.encoding() != Encoding::Linear {
            *picture = store(&self.render_linear_with(frame, renderer), frame.encoding());
            return;
        }
        if (picture.width(), picture.height()) != (frame.picture_width(), frame.picture_height()) {
            *picture = empty(frame);
        }
        self.draw(frame, renderer, picture);
    }

    /// Draws `frame` with an engine and an instruction set, before rounding: linear channels, clamped to 0..=1.
    pub fn render_linear_with(&self, frame: &Frame, renderer: Renderer) -> LinearPicture {
        let mut picture = empty(frame);
        self.draw(frame, renderer, &mut picture);
        picture
    }

    /// Draws `frame` into a picture of its size.
    fn draw<T: Stored>(&self, frame: &Frame, renderer: Renderer, picture: &mut Picture<T>) {
        #[cfg(feature = "simd")]
        if let Some(Renderer::Row(level)) = self.plan(frame, renderer).renderer() {
            let is_bytes = T::bytes(&mut []).is_some();
            let pixels = picture.pixels_mut();
            return super::rows::draw(self, frame, level, is_bytes, &mut |height, draw| {
                draw_bands(frame, (height, 0), pixels, draw);
            });
        }
        picture.pixels_mut().fill(T::background(frame));
        let _ = renderer; // without SIMD there is one engine
        let setup = SetUp::new(self, frame, (Level::Scalar, 1.0, Vec::new()));
        draw_rows(frame, picture.pixels_mut(), |target| {
            spans::draw(&setup, target)
        });
    }

    /// Draws `frame` as [`Variant::render_with`] does, and gives its pixels to `take` from the top, some rows at a time, each
    /// soon after it was drawn. The picture is in memory as a whole only where the span engine draws it, and for sRGB.
    ///
    /// # Errors
    /// Returns the error of `take`, after which no more is drawn.
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
    /// })?;
    /// assert_eq!(pixels, frame.picture_width() * frame.picture_height());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn render_rows<E>(
        &self,
        frame: &Frame,
        renderer: Renderer,
        mut take: impl FnMut(&[[u8; 4]]) -> Result<(), E>,
    ) -> Result<(), E> {
        #[cfg(feature = "simd")]
        if let Some(Renderer::Row(level)) = self.plan(frame, renderer).renderer()
            && frame.encoding() == Encoding::Linear
        {
            let mut taken = Ok(());
            super::rows::draw(self, frame, level, true, &mut |height, draw| {
                let mut take = |pixels: &[[u8; 4]]| {
                    taken = take(pixels);
                    taken.is_ok()
                };
                stream_bands(frame, height, &mut take, draw);
            });
            return taken;
        }
        let mut picture = Picture8::new(0, 0, [0; 4]);
        self.render_with(frame, renderer, &mut picture);
        take(picture.pixels())
    }

    /// Draws the triangles of `frame` with the barycentric renderer. Returns `None` if it does not have this method.
    pub fn render_barycentric(&self, frame: &Frame, edges: Edges) -> Option<Picture8> {
        match frame.encoding() {
            Encoding::Linear => self.triangles(frame, edges),
            encoding => Some(store(&self.triangles(frame, edges)?, encoding)),
        }
    }

    /// Draws as [`Variant::render_barycentric`], before rounding.
    pub fn render_barycentric_linear(&self, frame: &Frame, edges: Edges) -> Option<LinearPicture> {
        self.triangles(frame, edges)
    }

    /// Draws the triangles of `frame` over an empty picture.
    fn triangles<T: Stored>(&self, frame: &Frame, edges: Edges) -> Option<Picture<T>> {
        if !self.entry().is_barycentric() {
            return None;
        }
        let mut picture = empty(frame);
        let setup = SetUp::new(self, frame, (Level::Scalar, 1.0, Vec::new()));
        draw_anyhow(frame, picture.pixels_mut(), |target| {
            barycentric::draw(&setup, edges, target);
        });
        Some(picture)
    }
}
