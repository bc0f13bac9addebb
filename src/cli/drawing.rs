//! Render jobs: from a frame to a picture, by a method and an engine.

use super::engines::{ENGINES, EngineFlag, Simd, cs171_shading};
use super::log::Log;
use super::text::{counted, grouped};
use super::{CliError, aov::Aov};
use fastphong::compare::comparison::DrawnBy;
use fastphong::frame::Frame;
use fastphong::frame::triangulate::triangulated;
use fastphong::number::Level;
use fastphong::number::suggest::nearest;
use fastphong::picture::encoding::store;
use fastphong::picture::image_file::{FilePicture, FilePixels};
use fastphong::picture::{Encoding, Picture, Picture8};
use fastphong::raster::{self, Edges, Plan, Renderer};
use fastphong::reference::cs171::{self, Reading, Shading};
use fastphong::reference::{self, Model};
use fastphong::shading::{METHODS, Variant};
use std::fmt;

/// The name under which the reference picture can be asked for like a method.
const REFERENCE: &str = "reference";

/// The name under which the choice of the method is left to the program.
pub const AUTO: &str = "auto";

/// The source of the colours.
#[derive(Clone, Debug)]
pub enum Method {
    /// A method of the table.
    Variant(Variant),
    /// The closed form that methods are measured against, in `f64`.
    Reference(Model),
}

/// Reads `NAME`, `NAME:key=value`, `reference` or `reference:model=NAME`.
pub fn method(text: &str) -> Result<Method, String> {
    let (name, rest) = text.split_once(':').unwrap_or((text, ""));
    if name == REFERENCE {
        let named = Model::ALL.map(|model| (format!("model={}", model.name()), model));
        return match named.iter().find(|(name, _)| name == rest) {
            _ if rest.is_empty() => Ok(Method::Reference(Model::Phong)),
            Some((_, model)) => Ok(Method::Reference(*model)),
            None => {
                let names = named.map(|(name, _)| name).join(", ");
                Err(format!("`{rest}`: expected one of {names}"))
            }
        };
    }
    let means_method = nearest(name, METHODS.iter().map(|entry| entry.info.name)).is_some();
    let error = match Variant::parse(text) {
        Ok(variant) => return Ok(Method::Variant(variant)),
        Err(error) => error.to_string(),
    };
    match nearest(name, [REFERENCE, AUTO]) {
        Some(near) if !means_method => {
            Err(format!("unknown method `{name}`: did you mean `{near}`?"))
        }
        None if !means_method && Variant::parse(name).is_err() => {
            Err(format!("{error}, `{AUTO}`, `{REFERENCE}`"))
        }
        _ => Err(error),
    }
}

impl fmt::Display for Method {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Method::Variant(variant) => variant.fmt(f),
            Method::Reference(Model::Phong) => f.write_str(REFERENCE),
            Method::Reference(model) => write!(f, "{REFERENCE}:model={}", model.name()),
        }
    }
}

/// The quantity that a picture shows.
#[derive(Clone, Debug)]
pub enum PictureContent {
    /// Colours; the engine and the instruction set asked for, and the renderer that they name.
    Shaded(Method, EngineFlag, Simd, Renderer),
    /// Another quantity; the side of a square of the checkerboard, in world units.
    Aov(Aov, f64),
}

/// A frame to draw, and the quantity that its picture shows.
pub struct RenderJob {
    frame: Frame,
    content: PictureContent,
    /// True if alpha is full everywhere, whatever is covered.
    pub opaque: bool,
}

impl RenderJob {
    /// Prepares `frame` for the engine: the barycentric renderer and CS171's algorithms take triangles.
    ///
    /// # Errors
    /// When the engine does not have the method or the instruction set.
    pub fn new(frame: Frame, content: PictureContent, log: Log) -> Result<RenderJob, CliError> {
        let job = |frame, content| {
            Ok(RenderJob {
                frame,
                content,
                opaque: false,
            })
        };
        let PictureContent::Shaded(method, engine, simd, _) = &content else {
            return job(frame, content);
        };
        let (name, title) = match (engine, method) {
            (EngineFlag::Barycentric(_), _) => ("barycentric", "the barycentric renderer"),
            (EngineFlag::Cs171 { .. }, _) => ("cs171", "CS171"),
            (EngineFlag::Scanlines(Some(engine)), Method::Reference(_)) => {
                let problem = format!("`{method}` is not drawn by the {engine} engine");
                return Err(format!("{problem}: leave out --engine").into());
            }
            (EngineFlag::Scanlines(None), Method::Reference(_)) => {
                refuse_simd("the reference", *simd)?;
                return job(frame, content);
            }
            _ => return job(frame, content),
        };
        let engine = ENGINES.iter().filter(|engine| engine.name == name);
        let has: Vec<&str> = engine.flat_map(|engine| engine.methods()).collect();
        let is_known = |variant: &Variant| has.contains(&variant.info().name);
        if !matches!(method, Method::Variant(variant) if is_known(variant)) {
            let problem = format!("{title} does not support the method `{method}`");
            return Err(format!("{problem}: expected one of {}", has.join(", ")).into());
        }
        refuse_simd(title, *simd)?;
        let frame = in_triangles(frame, title, log);
        job(frame, content)
    }

    /// Returns the renderer of a method that is drawn by scanlines, with the reason if it is not the one asked for.
    fn plan(&self) -> Option<Plan> {
        match &self.content {
            PictureContent::Shaded(
                Method::Variant(variant),
                EngineFlag::Scanlines(_),
                _,
                renderer,
            ) => Some(variant.plan(&self.frame, *renderer)),
            _ => None,
        }
    }

    /// Logs which loops draw the picture: as a note where they are not those that were asked for.
    pub fn log(&self, threads: Option<usize>, log: Log) {
        let plan = self.plan();
        let drawn_by = match (&plan, self.engine()) {
            (Some(plan), _) => DrawnBy::new(plan.renderer).to_string(),
            (None, REFERENCE) => "the reference, f64, 1 thread".to_owned(),
            (None, "cs171") => "the cs171 engine, f64, 1 thread".to_owned(),
            (None, engine) => format!("the {engine} engine, scalar, 1 thread"),
        };
        let used = plan.as_ref().map_or(1, |plan| plan.renderer.threads());
        let is_other = match (&self.content, &plan) {
            (PictureContent::Shaded(_, EngineFlag::Scanlines(asked), simd, _), Some(plan)) => {
                asked.is_some_and(|asked| asked != plan.renderer.engine())
                    || matches!(simd, Simd::Level(asked) if *asked != plan.renderer.level())
            }
            _ => false,
        };
        let reason = plan.and_then(|plan| plan.reason);
        let reason = reason.map_or(String::new(), |reason| format!(": {reason}"));
        match is_other && !reason.is_empty() {
            true => log.note(&format!("drawn by {drawn_by}{reason}")),
            false => log.detail(&format!("drawn by {drawn_by}{reason}")),
        }
        if let (Some(threads @ 2..), 1) = (threads, used) {
            let text = format!("--threads {threads} leaves the pixels on one thread");
            log.note(&format!("{text}: drawn by {drawn_by}"));
        }
    }

    /// Passes the pixels of the picture, as stored in 8 bits, to `take`: row by row from the top, and where possible while it
    /// is drawn.
    ///
    /// # Errors
    /// Those of `take`.
    pub fn rows<E>(&self, mut take: impl FnMut(&[[u8; 4]]) -> Result<(), E>) -> Result<(), E> {
        match &self.content {
            PictureContent::Shaded(
                Method::Variant(variant),
                EngineFlag::Scanlines(_),
                _,
                renderer,
            ) => variant.render_rows(&self.frame, *renderer, take),
            _ => take(self.picture(false).to_stored().pixels()),
        }
    }

    /// Returns the name of the method, or of the quantity that is shown instead of colours.
    pub fn name(&self) -> String {
        match &self.content {
            PictureContent::Shaded(method, ..) => method.to_string(),
            PictureContent::Aov(aov, _) => aov.name(),
        }
    }

    /// Returns the name of the engine that draws.
    pub fn engine(&self) -> &'static str {
        match &self.content {
            PictureContent::Aov(..) => raster::Engine::Span.name(),
            PictureContent::Shaded(Method::Reference(_), ..) => REFERENCE,
            PictureContent::Shaded(_, EngineFlag::Barycentric(_), ..) => "barycentric",
            PictureContent::Shaded(_, EngineFlag::Cs171 { .. }, ..) => "cs171",
            PictureContent::Shaded(_, EngineFlag::Scanlines(_), _, renderer) => {
                let plan = self.plan();
                plan.map_or(*renderer, |plan| plan.renderer).engine().name()
            }
        }
    }

    /// Returns width and height of the picture in pixels.
    pub fn size(&self) -> [usize; 2] {
        [self.frame.picture_width(), self.frame.picture_height()]
    }

    /// Draws the picture: floats if `linear`, else as stored in 8 bits.
    pub fn picture(&self, linear: bool) -> FilePicture {
        let mut picture = self.drawn(linear);
        if self.opaque
            && let FilePixels::Stored(stored) = &mut picture.pixels
        {
            stored
                .pixels_mut()
                .iter_mut()
                .for_each(|pixel| pixel[3] = 255);
        }
        picture
    }

    fn drawn(&self, linear: bool) -> FilePicture {
        let frame = &self.frame;
        let (variant, engine, renderer) = match &self.content {
            PictureContent::Aov(aov, square) if linear => {
                return FilePicture::linear(aov.linear(frame, *square));
            }
            PictureContent::Aov(aov, square) => {
                return FilePicture::stored(aov.stored(frame, *square));
            }
            PictureContent::Shaded(Method::Reference(model), ..) => {
                let picture = reference::render(frame, *model).picture;
                return from_f64(&picture, frame.encoding(), linear);
            }
            PictureContent::Shaded(Method::Variant(variant), engine, _, renderer) => {
                (variant, engine, *renderer)
            }
        };
        match engine {
            EngineFlag::Scanlines(_) => by_scanlines(frame, variant, renderer, linear),
            EngineFlag::Barycentric(edges) => barycentric(frame, variant, *edges, linear),
            EngineFlag::Cs171 { normalise } => {
                // `RenderJob::new` checked that CS171 has the method. The frame has decided which sides are left out.
                let shading = cs171_shading(variant.info()).unwrap_or(Shading::Phong);
                let reading = Reading {
                    normalise: *normalise,
                    cull: false,
                    ..Reading::default()
                };
                let picture = cs171::render(frame, shading, reading);
                from_f64(&picture.filtered(frame.samples()), frame.encoding(), linear)
            }
        }
    }
}

/// Refuses an instruction set for an engine that shades one pixel at a time.
fn refuse_simd(engine: &str, simd: Simd) -> Result<(), CliError> {
    match simd {
        Simd::Auto | Simd::Level(Level::Scalar) => Ok(()),
        Simd::Level(level) => {
            let problem = format!("{engine} goes pixel by pixel and has no `{level}`");
            Err(format!("{problem}: expected --simd auto or scalar").into())
        }
    }
}

/// Returns `frame` with its polygons cut into triangles, if it has others.
fn in_triangles(frame: Frame, engine: &str, log: Log) -> Frame {
    let polygons = frame.polygons().iter();
    let with_more_corners = polygons.filter(|polygon| polygon.count > 3).count();
    if with_more_corners == 0 {
        return frame;
    }
    let cut = triangulated(&frame);
    let [of, into] = [with_more_corners, cut.frame.polygons().len()].map(grouped);
    let done = format!("{of} polygons of more than three corners are cut into triangles");
    log.note(&format!("{done} for {engine}: {into} in all"));
    if cut.not_simple > 0 {
        log.warning(&counted(
            cut.not_simple,
            "polygon crosses or overlaps itself and is left out",
            "polygons cross or overlap themselves and are left out",
        ));
    }
    cut.frame
}

/// Converts a picture in `f64` to one that can be written to a file.
fn from_f64(picture: &Picture<[f64; 4]>, encoding: Encoding, linear: bool) -> FilePicture {
    let single = || picture.map(|pixel| pixel.map(|c| c as f32));
    match (linear, encoding) {
        (true, _) => FilePicture::linear(single()),
        (false, Encoding::Linear) => {
            FilePicture::stored(picture.map(|pixel| pixel.map(|c| (255.0 * c).round() as u8)))
        }
        (false, Encoding::Srgb) => FilePicture::stored(store(&single(), Encoding::Srgb)),
    }
}

fn by_scanlines(frame: &Frame, variant: &Variant, renderer: Renderer, linear: bool) -> FilePicture {
    if linear {
        return FilePicture::linear(variant.render_linear_with(frame, renderer));
    }
    // Every pixel is drawn or becomes background. Zeroed memory is untouched until the threads that draw write to it, each
    // in rows of its own.
    let mut picture = Picture8::new(frame.picture_width(), frame.picture_height(), [0; 4]);
    variant.render_with(frame, renderer, &mut picture);
    FilePicture::stored(picture)
}

fn barycentric(frame: &Frame, variant: &Variant, edges: Edges, linear: bool) -> FilePicture {
    let picture = if linear {
        let picture = variant.render_barycentric_linear(frame, edges);
        picture.map(FilePicture::linear)
    } else {
        let picture = variant.render_barycentric(frame, edges);
        picture.map(FilePicture::stored)
    };
    // `RenderJob::new` checked that the barycentric renderer has the method; without it the span engine would draw.
    picture.unwrap_or_else(|| by_scanlines(frame, variant, Renderer::LECTURE, linear))
}
