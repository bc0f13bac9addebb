//! How a frame becomes a picture: which method, which engine.

use super::talk::{Talk, grouped};
use super::{Failure, aov::Aov};
use fastphong::cs171::{self, Reading, Shading};
use fastphong::encoding::store;
use fastphong::frame::Frame;
use fastphong::image_file::FilePicture;
use fastphong::picture::Picture;
use fastphong::raster::Edges;
use fastphong::reference::{self, Model};
use fastphong::scene::Encoding;
use fastphong::shader::{Info, METHODS, Variant};
use fastphong::suggest::nearest;
use fastphong::triangulate::triangulated;

/// The name under which the reference picture can be asked for like a method.
const REFERENCE: &str = "reference";

/// What shades the pixels.
#[derive(Clone, Debug)]
pub enum Method {
    /// A method of the table.
    Variant(Variant),
    /// The closed form that methods are measured against, in `f64`.
    Reference(Model),
}

/// `NAME`, `NAME:key=value`, `reference` or `reference:model=NAME`.
pub fn method(text: &str) -> Result<Method, String> {
    let (name, rest) = text.split_once(':').unwrap_or((text, ""));
    if name == REFERENCE {
        if rest.is_empty() {
            return Ok(Method::Reference(Model::Phong));
        }
        let named = |name: &str| Model::ALL.into_iter().find(|model| model.name() == name).map(Method::Reference);
        return rest.strip_prefix("model=").and_then(named).ok_or_else(|| {
            let models: Vec<String> = Model::ALL.iter().map(|model| format!("model={}", model.name())).collect();
            format!("`{rest}`: expected one of {}", models.join(", "))
        });
    }
    let is_method = METHODS.iter().any(|entry| entry.info.name == name);
    let means_method = nearest(name, METHODS.iter().map(|entry| entry.info.name)).is_some();
    if !is_method && !means_method && nearest(name, [REFERENCE]).is_some() {
        return Err(format!("unknown method `{name}`: did you mean `{REFERENCE}`?"));
    }
    Variant::parse(text).map(Method::Variant).map_err(|error| error.to_string())
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

/// What finds the pixels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Engine {
    /// Edge table and spans, as in the lecture.
    #[default]
    Scanline,
    /// Bounding boxes and edge functions.
    Barycentric(Edges),
    /// CS171's algorithms as printed, in `f64`.
    Cs171 {
        /// Whether interpolated normals are made unit vectors, which the text leaves out.
        normalise: bool,
    },
}

/// The methods that CS171 has, by their names here.
const CS171: [(&str, Shading); 3] =
    [("flat-average", Shading::Flat), ("gouraud", Shading::Gouraud), ("naive-phong", Shading::Phong)];

/// The engines that have a method.
pub fn engines(info: &Info) -> String {
    let mut all = vec!["scanline"];
    all.extend(info.barycentric.then_some("barycentric"));
    all.extend(CS171.iter().any(|(name, _)| *name == info.name).then_some("cs171"));
    all.join(", ")
}

/// What CS171 calls a method, if it has it.
fn cs171_shading(method: &Method) -> Option<Shading> {
    let Method::Variant(variant) = method else { return None };
    CS171.iter().find(|(name, _)| *name == variant.info().name).map(|(_, shading)| *shading)
}

/// `scanline`, `barycentric`, `barycentric:edges=top-left|closed`, `cs171` or `cs171:normals=unit|as-printed`.
pub fn engine(text: &str) -> Result<Engine, String> {
    match text {
        "scanline" | "span" => Ok(Engine::Scanline),
        "barycentric" | "barycentric:edges=top-left" => Ok(Engine::Barycentric(Edges::TopLeft)),
        "barycentric:edges=closed" => Ok(Engine::Barycentric(Edges::Closed)),
        "cs171" | "cs171:normals=unit" => Ok(Engine::Cs171 { normalise: true }),
        "cs171:normals=as-printed" => Ok(Engine::Cs171 { normalise: false }),
        _ => Err(match (nearest(text, ["scanline", "barycentric", "cs171"]), text.split_once(':')) {
            (Some(near), _) => format!("unknown engine: did you mean `{near}`?"),
            (None, Some(("barycentric", _))) => "expected edges=top-left or edges=closed".to_owned(),
            (None, Some(("cs171", _))) => "expected normals=unit or normals=as-printed".to_owned(),
            (None, Some(("scanline" | "span", _))) => "the scanline engine has no parameters".to_owned(),
            (None, _) => "expected `scanline`, `barycentric` or `cs171`".to_owned(),
        }),
    }
}

/// What of a frame is put into a picture.
#[derive(Clone, Debug)]
pub enum Content {
    /// Colours.
    Shaded(Method, Engine),
    /// Something else that is known of each pixel; the side of a square of the checkerboard, in world units.
    Aov(Aov, f64),
}

/// A frame, and what of it is put into a picture.
pub struct Drawing {
    frame: Frame,
    content: Content,
}

impl Drawing {
    /// Prepares `frame` for the engine: the barycentric renderer and CS171's algorithms take triangles.
    ///
    /// # Errors
    /// When the engine does not have the method.
    pub fn new(frame: Frame, content: Content, talk: Talk) -> Result<Drawing, Failure> {
        let (engine, has) = match &content {
            Content::Shaded(_, Engine::Barycentric(_)) => {
                let has = METHODS.iter().filter(|entry| entry.info.barycentric).map(|entry| entry.info.name);
                ("the barycentric renderer", has.collect::<Vec<_>>())
            }
            Content::Shaded(_, Engine::Cs171 { .. }) => ("CS171", CS171.map(|(name, _)| name).to_vec()),
            _ => return Ok(Drawing { frame, content }),
        };
        let Content::Shaded(method, _) = &content else { return Ok(Drawing { frame, content }) };
        let known = matches!(method, Method::Variant(variant) if has.contains(&variant.info().name));
        if !known {
            return Err(format!("{engine} does not have `{method}`: expected one of {}", has.join(", ")).into());
        }
        let with_more_corners = frame.polygons().iter().filter(|polygon| polygon.count > 3).count();
        if with_more_corners == 0 {
            return Ok(Drawing { frame, content });
        }
        let cut = triangulated(&frame);
        let (of, into) = (grouped(with_more_corners), grouped(cut.frame.polygons().len()));
        talk.note(&format!(
            "{of} polygons of more than three corners are cut into triangles for {engine}: {into} in all"
        ));
        if cut.not_simple > 0 {
            talk.warning(&match cut.not_simple {
                1 => "1 polygon crosses or overlaps itself and is left out".to_owned(),
                n => format!("{} polygons cross or overlap themselves and are left out", grouped(n)),
            });
        }
        Ok(Drawing { frame: cut.frame, content })
    }

    /// The picture: floats if `linear`, else as it is stored in 8 bits.
    pub fn picture(&self, linear: bool) -> FilePicture {
        let frame = &self.frame;
        match (&self.content, linear) {
            (Content::Aov(aov, square), true) => FilePicture::linear(aov.linear(frame, *square)),
            (Content::Aov(aov, square), false) => FilePicture::stored(aov.stored(frame, *square)),
            (Content::Shaded(Method::Reference(model), _), linear) => {
                wide(&reference::render(frame, *model).picture, frame.encoding(), linear)
            }
            (Content::Shaded(method, Engine::Cs171 { normalise }), linear) => {
                // `Drawing::new` asked whether CS171 has the method. Which sides are left out, the frame has decided.
                let shading = cs171_shading(method).unwrap_or(Shading::Phong);
                let reading = Reading { normalise: *normalise, cull: false, ..Reading::default() };
                wide(&cs171::render(frame, shading, reading).filtered(frame.samples()), frame.encoding(), linear)
            }
            (Content::Shaded(Method::Variant(variant), engine), linear) => shaded(frame, variant, *engine, linear),
        }
    }
}

/// A picture in `f64` as a file has it.
fn wide(picture: &Picture<[f64; 4]>, encoding: Encoding, linear: bool) -> FilePicture {
    let single = || picture.map(|texel| texel.map(|c| c as f32));
    match (linear, encoding) {
        (true, _) => FilePicture::linear(single()),
        (false, Encoding::Linear) => FilePicture::stored(picture.map(|texel| texel.map(|c| (255.0 * c).round() as u8))),
        (false, Encoding::Srgb) => FilePicture::stored(store(&single(), Encoding::Srgb)),
    }
}

fn shaded(frame: &Frame, variant: &Variant, engine: Engine, linear: bool) -> FilePicture {
    // `Drawing::new` asked whether the barycentric renderer has the method; were it not so, the lecture's engine does.
    if let Engine::Barycentric(edges) = engine {
        let picture = match linear {
            true => variant.render_barycentric_linear(frame, edges).map(FilePicture::linear),
            false => variant.render_barycentric(frame, edges).map(FilePicture::stored),
        };
        if let Some(picture) = picture {
            return picture;
        }
    }
    match linear {
        true => FilePicture::linear(variant.render_linear(frame)),
        false => FilePicture::stored(variant.render(frame)),
    }
}
