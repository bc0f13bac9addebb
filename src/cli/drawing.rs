//! From a frame to a picture, by a method and an engine.

use super::engines::{ENGINES, Engine, Simd, cs171_shading};
use super::talk::{Talk, counted, grouped};
use super::{Failure, aov::Aov};
use fastphong::frame::Frame;
use fastphong::frame::triangulate::triangulated;
use fastphong::number::Level;
use fastphong::number::suggest::nearest;
use fastphong::picture::encoding::store;
use fastphong::picture::image_file::{FilePicture, FileTexels};
use fastphong::picture::{Encoding, Picture, Picture8};
use fastphong::raster::{self, Edges, Renderer};
use fastphong::reference::cs171::{self, Reading, Shading};
use fastphong::reference::{self, Model};
use fastphong::shading::{METHODS, Variant};

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
        if rest.is_empty() {
            return Ok(Method::Reference(Model::Phong));
        }
        let named = Model::ALL.map(|model| (format!("model={}", model.name()), model));
        return match named.iter().find(|(name, _)| name == rest) {
            Some((_, model)) => Ok(Method::Reference(*model)),
            None => {
                let names = named.map(|(name, _)| name).join(", ");
                Err(format!("`{rest}`: expected one of {names}"))
            }
        };
    }
    let is_method = METHODS.iter().any(|entry| entry.info.name == name);
    let means_method = nearest(name, METHODS.iter().map(|entry| entry.info.name)).is_some();
    if !is_method
        && !means_method
        && let Some(near) = nearest(name, [REFERENCE, AUTO])
    {
        let problem = format!("unknown method `{name}`");
        return Err(format!("{problem}: did you mean `{near}`?"));
    }
    let variant = Variant::parse(text).map_err(|error| error.to_string());
    variant.map(Method::Variant)
}

impl std::fmt::Display for Method {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Method::Variant(variant) => variant.fmt(f),
            Method::Reference(Model::Phong) => f.write_str(REFERENCE),
            Method::Reference(model) => write!(f, "{REFERENCE}:model={}", model.name()),
        }
    }
}

/// The part of a frame that is put into a picture.
#[derive(Clone, Debug)]
pub enum Content {
    /// Colours; the engine and the instruction set asked for, and what these mean by scanlines.
    Shaded(Method, Engine, Simd, Renderer),
    /// Something else that is known of each pixel; the side of a square of the checkerboard, in world units.
    Aov(Aov, f64),
}

/// A frame, and what of it is put into a picture.
pub struct Drawing {
    frame: Frame,
    content: Content,
    /// True if alpha is full everywhere, whatever is covered.
    pub opaque: bool,
}

impl Drawing {
    /// Prepares `frame` for the engine: the barycentric renderer and CS171's algorithms take triangles.
    ///
    /// # Errors
    /// When the engine does not have the method or the instruction set.
    pub fn new(frame: Frame, content: Content, talk: Talk) -> Result<Drawing, Failure> {
        let drawn = |frame, content| {
            Ok(Drawing {
                frame,
                content,
                opaque: false,
            })
        };
        let Content::Shaded(method, engine, simd, _) = &content else {
            return drawn(frame, content);
        };
        let (name, title) = match (engine, method) {
            (Engine::Barycentric(_), _) => ("barycentric", "the barycentric renderer"),
            (Engine::Cs171 { .. }, _) => ("cs171", "CS171"),
            (Engine::Scanlines(Some(engine)), Method::Reference(_)) => {
                let problem = format!("the {engine} engine does not have `{method}`");
                return Err(format!("{problem}, which is none: leave out --engine").into());
            }
            (Engine::Scanlines(None), Method::Reference(_)) => {
                pixel_by_pixel("the reference", *simd)?;
                return drawn(frame, content);
            }
            _ => return drawn(frame, content),
        };
        let engine = ENGINES.iter().filter(|engine| engine.name == name);
        let has: Vec<&str> = engine.flat_map(|engine| engine.methods()).collect();
        let is_known = |variant: &Variant| has.contains(&variant.info().name);
        if !matches!(method, Method::Variant(variant) if is_known(variant)) {
            let problem = format!("{title} does not have `{method}`");
            return Err(format!("{problem}: expected one of {}", has.join(", ")).into());
        }
        pixel_by_pixel(title, *simd)?;
        drawn(in_triangles(frame, title, talk), content)
    }

    /// Says what draws the picture: in full to the curious, and to all where it is not what they asked for.
    pub fn tell(&self, threads: Option<usize>, talk: Talk) {
        let line = |engine: &str, level: &str, threads: usize| {
            let threads = counted(threads, "thread", "threads");
            format!("drawn by {engine}, {level}, {threads}")
        };
        let one = |engine: &str, level: &str| (line(engine, level, 1), 1, None);
        let (text, used, reason) = match &self.content {
            Content::Aov(..) => one("the span engine", "scalar"),
            Content::Shaded(Method::Reference(_), ..) => one("the reference", "f64"),
            Content::Shaded(_, Engine::Barycentric(_), ..) => {
                one("the barycentric engine", "scalar")
            }
            Content::Shaded(_, Engine::Cs171 { .. }, ..) => one("the cs171 engine", "f64"),
            Content::Shaded(Method::Variant(variant), Engine::Scanlines(asked), simd, renderer) => {
                let plan = variant.plan(&self.frame, *renderer);
                let (engine, level) = (plan.renderer.engine(), plan.renderer.level());
                let used = plan.renderer.threads();
                let text = line(&format!("the {engine} engine"), level.name(), used);
                let is_other = asked.is_some_and(|asked| asked != engine)
                    || matches!(simd, Simd::Level(asked) if *asked != level);
                let reason = plan.reason.map(|reason| (reason, is_other));
                (text, used, reason)
            }
        };
        match reason {
            Some((reason, true)) => talk.note(&format!("{text}: {reason}")),
            Some((reason, false)) => talk.detail(&format!("{text}: {reason}")),
            None => talk.detail(&text),
        }
        if let (Some(threads @ 2..), 1) = (threads, used) {
            let what = format!("--threads {threads} leaves the pixels on one thread");
            talk.note(&format!("{what}: {text}"));
        }
    }

    /// Gives the texels of the picture, as it is stored in 8 bits, to `take`: row by row from the top, and where that can be
    /// while it is drawn.
    ///
    /// # Errors
    /// Those of `take`.
    pub fn rows<E>(&self, mut take: impl FnMut(&[[u8; 4]]) -> Result<(), E>) -> Result<(), E> {
        match &self.content {
            Content::Shaded(Method::Variant(variant), Engine::Scanlines(_), _, renderer) => {
                variant.render_rows(&self.frame, *renderer, take)
            }
            _ => take(self.picture(false).to_stored().texels()),
        }
    }

    /// Returns the name of the method, or of the quantity that is shown instead of colours.
    pub fn name(&self) -> String {
        match &self.content {
            Content::Shaded(method, ..) => method.to_string(),
            Content::Aov(aov, _) => aov.name(),
        }
    }

    /// Returns the name of the engine that draws.
    pub fn engine(&self) -> &'static str {
        match &self.content {
            Content::Aov(..) => raster::Engine::Span.name(),
            Content::Shaded(Method::Reference(_), ..) => REFERENCE,
            Content::Shaded(_, Engine::Barycentric(_), ..) => "barycentric",
            Content::Shaded(_, Engine::Cs171 { .. }, ..) => "cs171",
            Content::Shaded(Method::Variant(variant), Engine::Scanlines(_), _, renderer) => variant
                .plan(&self.frame, *renderer)
                .renderer
                .engine()
                .name(),
        }
    }

    /// Returns width and height of the picture in pixels.
    pub fn size(&self) -> [usize; 2] {
        [self.frame.picture_width(), self.frame.picture_height()]
    }

    /// Draws the picture: floats if `linear`, else as it is stored in 8 bits.
    pub fn picture(&self, linear: bool) -> FilePicture {
        let mut picture = self.drawn(linear);
        if self.opaque
            && let FileTexels::Stored(stored) = &mut picture.texels
        {
            stored
                .texels_mut()
                .iter_mut()
                .for_each(|texel| texel[3] = 255);
        }
        picture
    }

    fn drawn(&self, linear: bool) -> FilePicture {
        let frame = &self.frame;
        match (&self.content, linear) {
            (Content::Aov(aov, square), true) => FilePicture::linear(aov.linear(frame, *square)),
            (Content::Aov(aov, square), false) => FilePicture::stored(aov.stored(frame, *square)),
            (Content::Shaded(Method::Reference(model), ..), linear) => {
                let picture = reference::render(frame, *model).picture;
                wide(&picture, frame.encoding(), linear)
            }
            (Content::Shaded(Method::Variant(variant), engine, _, renderer), linear) => {
                match engine {
                    Engine::Scanlines(_) => by_scanlines(frame, variant, *renderer, linear),
                    Engine::Barycentric(edges) => barycentric(frame, variant, *edges, linear),
                    Engine::Cs171 { normalise } => {
                        // `Drawing::new` asked whether CS171 has the method. Which sides are left out, the frame has decided.
                        let shading = cs171_shading(variant.info()).unwrap_or(Shading::Phong);
                        let reading = Reading {
                            normalise: *normalise,
                            cull: false,
                            ..Reading::default()
                        };
                        let picture = cs171::render(frame, shading, reading);
                        let picture = picture.filtered(frame.samples());
                        wide(&picture, frame.encoding(), linear)
                    }
                }
            }
        }
    }
}

/// Refuses an instruction set for what shades one pixel at a time.
fn pixel_by_pixel(what: &str, simd: Simd) -> Result<(), Failure> {
    match simd {
        Simd::Auto | Simd::Level(Level::Scalar) => Ok(()),
        Simd::Level(level) => {
            let problem = format!("{what} goes pixel by pixel and has no `{level}`");
            Err(format!("{problem}: expected --simd auto or scalar").into())
        }
    }
}

/// Returns `frame` with its polygons cut into triangles, if it has others.
fn in_triangles(frame: Frame, engine: &str, talk: Talk) -> Frame {
    let polygons = frame.polygons().iter();
    let with_more_corners = polygons.filter(|polygon| polygon.count > 3).count();
    if with_more_corners == 0 {
        return frame;
    }
    let cut = triangulated(&frame);
    let [of, into] = [with_more_corners, cut.frame.polygons().len()].map(grouped);
    let what = format!("{of} polygons of more than three corners are cut into triangles");
    talk.note(&format!("{what} for {engine}: {into} in all"));
    if cut.not_simple > 0 {
        talk.warning(&counted(
            cut.not_simple,
            "polygon crosses or overlaps itself and is left out",
            "polygons cross or overlap themselves and are left out",
        ));
    }
    cut.frame
}

/// Returns a picture in `f64` as a file has it.
fn wide(picture: &Picture<[f64; 4]>, encoding: Encoding, linear: bool) -> FilePicture {
    let single = || picture.map(|texel| texel.map(|c| c as f32));
    match (linear, encoding) {
        (true, _) => FilePicture::linear(single()),
        (false, Encoding::Linear) => {
            FilePicture::stored(picture.map(|texel| texel.map(|c| (255.0 * c).round() as u8)))
        }
        (false, Encoding::Srgb) => FilePicture::stored(store(&single(), Encoding::Srgb)),
    }
}

fn by_scanlines(frame: &Frame, variant: &Variant, renderer: Renderer, linear: bool) -> FilePicture {
    if linear {
        return FilePicture::linear(variant.render_linear_with(frame, renderer));
    }
    // Every texel is drawn or becomes background. Zeros are memory that nothing has touched yet: the threads that draw are
    // the first, each in rows of its own.
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
    // `Drawing::new` asked whether the barycentric renderer has the method; were it not so, the lecture's engine does.
    picture.unwrap_or_else(|| by_scanlines(frame, variant, Renderer::LECTURE, linear))
}
