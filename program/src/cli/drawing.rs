//! Render jobs: each draws the picture of a frame by a method and an engine.

use super::aov::{Aov, Subject};
use super::engines::{ENGINES, EngineFlag, EngineInfo, Simd, cs171_shading};
use super::text::{counted, grouped};
use super::{CliError, Log};
use crate::compare::comparison::DrawnBy;
use fastphong::drawing::{Drawing, stored_background};
use fastphong::frame::Frame;
use fastphong::frame::triangulate::triangulated;
use fastphong::number::SimdLevel;
use fastphong::picture::encoding::store_f64;
use fastphong::picture::image_file::{FilePicture, FilePixels, Format, PpmWriter};
use fastphong::picture::{Alpha, Encoding, Picture};
use fastphong::raster::{Edges, Plan, Renderer};
use fastphong::reference::cs171::{self, Reading, Shading};
use fastphong::reference::{self, Model};
use fastphong::shading::Variant;
use std::io::{self, Write};

/// What a picture shows, and the engine that draws it.
enum PictureContent {
    /// Colours, drawn by a scanline engine.
    Scanlines(Variant, Renderer),
    /// Colours, drawn by the barycentric renderer.
    Barycentric(Variant, Edges),
    /// Colours, drawn by CS171's algorithms.
    Cs171(Shading, Reading),
    /// Colours of the closed form.
    Reference(Model),
    /// A quantity other than colour.
    Aov(Aov, Subject),
}

/// A frame to draw, and what its picture shows.
pub struct RenderJob {
    frame: Frame,
    content: PictureContent,
    /// The name of the method, or of the quantity shown instead of colours.
    pub name: String,
    /// True if every pixel gets full alpha, covered or not.
    pub opaque: bool,
}

impl RenderJob {
    fn new(frame: Frame, content: PictureContent, name: String) -> RenderJob {
        RenderJob {
            frame,
            content,
            name,
            opaque: false,
        }
    }

    /// Makes a job that shows a quantity other than colour.
    pub fn aov(frame: Frame, aov: Aov, subject: Subject) -> RenderJob {
        RenderJob::new(frame, PictureContent::Aov(aov, subject), aov.name())
    }

    /// Makes a job that shows colours. `renderer` is used by scanline engines only. For the
    /// barycentric renderer and CS171's algorithms, the frame is cut into triangles.
    ///
    /// # Errors
    /// If the engine does not have the method or the instruction set, or the method refuses the
    /// frame.
    pub fn shaded(
        frame: Frame,
        method: &Drawing,
        engine: EngineFlag,
        simd: Simd,
        renderer: Renderer,
        log: Log,
    ) -> Result<RenderJob, CliError> {
        let name = method.to_string();
        let (title, content) = match (engine, method) {
            (EngineFlag::Scanlines(_), Drawing::Auto) => {
                unreachable!("a method was chosen before")
            }
            (EngineFlag::Scanlines(_), Drawing::Variant(variant)) => {
                if let Plan::Refused(reason) = variant.plan(&frame, renderer) {
                    return Err(format!("`{variant}` cannot draw this picture: {reason}").into());
                }
                let content = PictureContent::Scanlines(variant.clone(), renderer);
                return Ok(RenderJob::new(frame, content, name));
            }
            (EngineFlag::Scanlines(Some(engine)), Drawing::Reference(_)) => {
                let engine = engine.name();
                let problem = format!("`{method}` is not drawn by the {engine} engine");
                return Err(format!("{problem}: leave out --engine").into());
            }
            (EngineFlag::Scanlines(None), Drawing::Reference(model)) => {
                ("the reference", PictureContent::Reference(*model))
            }
            (EngineFlag::Barycentric(edges), method) => {
                let title = "the barycentric renderer";
                let variant = supported(method, "barycentric", title)?.clone();
                (title, PictureContent::Barycentric(variant, edges))
            }
            (EngineFlag::Cs171 { normalise }, method) => {
                let variant = supported(method, "cs171", "CS171")?;
                let shading = cs171_shading(variant.info()).expect("a method of CS171");
                // The frame was culled when it was projected.
                let reading = Reading {
                    normalise,
                    cull: false,
                    ..Reading::default()
                };
                ("CS171", PictureContent::Cs171(shading, reading))
            }
        };
        if let Some(level) = simd.filter(|level| *level != SimdLevel::Scalar) {
            let problem = format!("{title} draws pixel by pixel and has no `{level}`");
            return Err(format!("{problem}: expected --simd auto or scalar").into());
        }
        let frame = match content {
            PictureContent::Reference(_) => frame,
            _ => in_triangles(frame, title, log),
        };
        Ok(RenderJob::new(frame, content, name))
    }

    /// Returns the loops that draw the picture, and the reason if they differ from those asked for.
    fn drawn_by(&self) -> (DrawnBy, Option<&'static str>) {
        let in_f64 = |engine| DrawnBy {
            engine,
            level: "f64",
            threads: 1,
        };
        let drawn_by = match &self.content {
            PictureContent::Scanlines(variant, renderer) => {
                let plan = variant.plan(&self.frame, *renderer);
                let drawn_by = plan.renderer().unwrap_or(*renderer);
                return (DrawnBy::new(drawn_by), plan.reason());
            }
            PictureContent::Barycentric(..) => DrawnBy::BARYCENTRIC,
            PictureContent::Cs171(..) => in_f64("cs171"),
            PictureContent::Reference(_) => in_f64(Drawing::REFERENCE),
            PictureContent::Aov(..) => DrawnBy::new(Renderer::LECTURE),
        };
        (drawn_by, None)
    }

    /// Returns the name of the engine that draws.
    pub fn engine(&self) -> &'static str {
        self.drawn_by().0.engine
    }

    /// Logs which loops draw the picture. This is a note if the user `asked` for an engine or an
    /// instruction set and another one draws it, otherwise a detail.
    pub fn log(&self, asked: bool, threads: Option<usize>, log: Log) {
        let (drawn_by, reason) = self.drawn_by();
        let shown = match drawn_by.engine {
            Drawing::REFERENCE => "the reference, f64, 1 thread".to_owned(),
            _ => drawn_by.to_string(),
        };
        match reason {
            Some(reason) if asked => log.note(&format!("drawn by {shown}: {reason}")),
            Some(reason) => log.detail(&format!("drawn by {shown}: {reason}")),
            None => log.detail(&format!("drawn by {shown}")),
        }
        if let (Some(threads @ 2..), 1) = (threads, drawn_by.threads) {
            let text = format!("--threads {threads} does not apply to the pixels");
            log.note(&format!("{text}: drawn by {shown}"));
        }
    }

    /// Writes the picture as a PPM file. Where the engine allows it, rows are written while later
    /// ones are still to be drawn.
    ///
    /// # Errors
    /// If `out` returns one.
    pub fn write_ppm(&mut self, out: &mut dyn Write) -> io::Result<()> {
        self.frame.set_alpha(Alpha::Flattened);
        let [width, height] = self.size();
        let mut file = PpmWriter::new(out, width, height).map_err(io::Error::other)?;
        match &self.content {
            PictureContent::Scanlines(variant, renderer) => {
                let drawn =
                    variant.render_rows(&self.frame, *renderer, |pixels| file.pixels(pixels));
                drawn.map_err(io::Error::other)??;
            }
            _ => match self.drawn(false).pixels {
                FilePixels::Stored(picture) => file.pixels(picture.pixels())?,
                _ => unreachable!("it is drawn in 8 bits"),
            },
        }
        file.finish()
    }

    /// Estimates the memory, in bytes, that drawing and writing a file of `format` takes beside the
    /// frame and the engine.
    pub fn memory_needed(&self, format: Format) -> u64 {
        let samples = (self.frame.width() * self.frame.height()) as u64;
        let pixels = self.size().map(|side| side as u64).iter().product::<u64>();
        let filtered = if self.frame.samples() > 1 { 32 } else { 0 };
        let (linear, stored) = (16, 4);
        let [a_sample, a_pixel] = match &self.content {
            PictureContent::Scanlines(variant, renderer) => {
                let renderer = variant.plan(&self.frame, *renderer).renderer();
                match format {
                    Format::Pfm => [0, linear],
                    Format::Png => [0, stored],
                    // Rows are written as they are drawn.
                    Format::Ppm if matches!(renderer, Some(Renderer::Row(_))) => [0, 0],
                    Format::Ppm => [0, stored],
                }
            }
            // The colour and the depth of each sample.
            PictureContent::Barycentric(..) => [linear + 4, linear + stored],
            // First `f64` colours with a depth buffer, then `f32` colours, then stored ones.
            PictureContent::Cs171(..) => [32 + 8, filtered + linear + stored],
            PictureContent::Reference(model) => {
                return Drawing::Reference(*model).memory_needed(&self.frame);
            }
            PictureContent::Aov(..) => [0, linear + 2 * stored],
        };
        a_sample * samples + a_pixel * pixels
    }

    /// Returns the frame.
    pub fn frame(&self) -> &Frame {
        &self.frame
    }

    /// Returns width and height of the picture in pixels.
    pub fn size(&self) -> [usize; 2] {
        [self.frame.picture_width(), self.frame.picture_height()]
    }

    /// Draws the picture for a file of `format`. PNG has straight alpha unless the job is opaque;
    /// other formats show the picture over the background. PFM holds linear floats, the others
    /// 8-bit levels.
    pub fn picture(&mut self, format: Format) -> FilePicture {
        let has_alpha = format == Format::Png;
        let is_straight = has_alpha && !self.opaque;
        self.frame.set_alpha(if is_straight {
            Alpha::Straight
        } else {
            Alpha::Flattened
        });
        let mut picture = self.drawn(format == Format::Pfm);
        picture.has_alpha = has_alpha;
        if let FilePixels::Stored(stored) = &mut picture.pixels {
            if self.opaque {
                stored.pixels_mut().iter_mut().for_each(|p| p[3] = 255);
            }
            picture.encoding = Some(self.stored_encoding());
        }
        if is_straight && !matches!(self.content, PictureContent::Aov(..)) {
            picture.background = Some(stored_background(&self.frame));
        }
        picture
    }

    /// Returns the encoding of the picture in 8 bits.
    fn stored_encoding(&self) -> Encoding {
        match &self.content {
            PictureContent::Aov(aov, _) => aov.encoding(&self.frame),
            _ => self.frame.encoding(),
        }
    }

    fn drawn(&self, linear: bool) -> FilePicture {
        const IS_FOR: &str = "another method was refused when the job was made";
        const HAS_METHOD: &str = "a method of the barycentric renderer";
        let frame = &self.frame;
        match &self.content {
            PictureContent::Scanlines(variant, renderer) if linear => {
                FilePicture::linear(variant.render_linear_with(frame, *renderer).expect(IS_FOR))
            }
            PictureContent::Scanlines(variant, renderer) => {
                FilePicture::stored(variant.render_with(frame, *renderer).expect(IS_FOR))
            }
            PictureContent::Barycentric(variant, edges) if linear => {
                let picture = variant.render_barycentric_linear(frame, *edges);
                FilePicture::linear(picture.expect(HAS_METHOD))
            }
            PictureContent::Barycentric(variant, edges) => {
                let picture = variant.render_barycentric(frame, *edges);
                FilePicture::stored(picture.expect(HAS_METHOD))
            }
            PictureContent::Cs171(shading, reading) => {
                let picture = cs171::render(frame, *shading, *reading);
                let picture = picture.filtered(frame.samples(), frame.alpha());
                from_f64(&picture, frame.encoding(), linear)
            }
            PictureContent::Reference(model) => {
                let picture = reference::render(frame, *model).picture;
                from_f64(&picture, frame.encoding(), linear)
            }
            PictureContent::Aov(aov, subject) if linear => {
                FilePicture::linear(aov.linear(frame, subject))
            }
            PictureContent::Aov(aov, subject) => FilePicture::stored(aov.stored(frame, subject)),
        }
    }
}

/// Returns the variant if the engine `name` has the method.
fn supported<'a>(method: &'a Drawing, name: &str, title: &str) -> Result<&'a Variant, CliError> {
    let engine = ENGINES.iter().filter(|engine| engine.name == name);
    let has: Vec<&str> = engine.flat_map(EngineInfo::methods).collect();
    match method {
        Drawing::Variant(variant) if has.contains(&variant.info().name) => Ok(variant),
        _ => {
            let problem = format!("{title} does not support the method `{method}`");
            Err(format!("{problem}: expected one of {}", has.join(", ")).into())
        }
    }
}

/// Returns `frame` with its polygons cut into triangles, and notes how many were cut.
fn in_triangles(frame: Frame, engine: &str, log: Log) -> Frame {
    let polygons = frame.polygons().iter();
    let with_more_corners = polygons.filter(|polygon| polygon.count > 3).count();
    if with_more_corners == 0 {
        return frame;
    }
    let cut = triangulated(&frame);
    let one = "polygon of more than three corners is cut into triangles";
    let more = "polygons of more than three corners are cut into triangles";
    let (done, into) = (
        counted(with_more_corners, one, more),
        grouped(cut.frame.polygons().len()),
    );
    log.note(&format!("{done} for {engine}: {into} in all"));
    if cut.not_simple > 0 {
        let one = "polygon crosses or overlaps itself and is left out";
        let more = "polygons cross or overlap themselves and are left out";
        log.warning(&counted(cut.not_simple, one, more));
    }
    cut.frame
}

/// Converts a picture in `f64` to one that can be written to a file.
fn from_f64(picture: &Picture<[f64; 4]>, encoding: Encoding, linear: bool) -> FilePicture {
    if linear {
        FilePicture::linear(picture.map(|pixel| pixel.map(|c| c as f32)))
    } else {
        FilePicture::stored(store_f64(picture, encoding))
    }
}
