//! What draws a picture, by the name that users type: a method, the reference, or the fastest
//! method.

use crate::frame::Frame;
use crate::number::NameError;
use crate::picture::encoding::{quantise, srgb_encode, store_f64};
use crate::picture::{Encoding, LinearPicture, Picture8, PictureMut};
use crate::raster::{DrawError, DrawOptions, Renderer};
use crate::reference::{self, Model};
use crate::shading::{METHODS, MethodRow, Variant};
use alloc::format;
use alloc::string::ToString;
use core::fmt;
use core::str::FromStr;

/// What draws a picture: `auto`, `reference`, `reference:model=gouraud`, or a method with its
/// parameters, `fast-phong:steps=1`.
///
/// ```
/// use fastphong::drawing::Drawing;
/// use fastphong::mesh::builtin::builtin;
/// use fastphong::raster::Renderer;
/// use fastphong::scene::Scene;
///
/// let frame = Scene::of_mesh(builtin("cube")?).frame()?;
/// let drawing: Drawing = "reference:model=flat".parse()?;
/// let exact = drawing.render(&frame, Renderer::fastest())?;
/// assert_eq!(exact.get(320, 240)[3], 255);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Drawing {
    /// The fastest method with naive Phong's picture: [`Variant::auto`].
    #[default]
    Auto,
    /// The `f64` closed form that methods are measured against.
    Reference(Model),
    /// A method.
    Variant(Variant),
}

impl Drawing {
    /// The name of [`Drawing::Auto`].
    pub const AUTO: &str = "auto";
    /// The name of the reference of Phong shading.
    pub const REFERENCE: &str = "reference";

    /// Returns the method that `renderer` draws `frame` by, and why if it was chosen automatically;
    /// `None` for the reference.
    pub fn variant(&self, frame: &Frame, renderer: Renderer) -> Option<(Variant, &'static str)> {
        match self {
            Drawing::Auto => Some(Variant::auto(frame, renderer)),
            Drawing::Reference(_) => None,
            Drawing::Variant(variant) => Some((variant.clone(), "")),
        }
    }

    /// Draws `frame` in eight bits, in its encoding and with its alpha. `renderer` has no part in a
    /// picture of the reference.
    ///
    /// # Errors
    /// As [`Variant::draw`].
    pub fn render(&self, frame: &Frame, renderer: Renderer) -> Result<Picture8, DrawError> {
        let (width, height) = (frame.picture_width(), frame.picture_height());
        let mut picture = Picture8::new(width, height, [0; 4]);
        self.render_into(frame, renderer, picture.pixels_mut())?;
        Ok(picture)
    }

    /// Draws `frame` as [`Drawing::render`] does, into `pixels`, which must be as many as the
    /// picture has.
    ///
    /// # Errors
    /// As [`Variant::draw`].
    pub fn render_into(
        &self,
        frame: &Frame,
        renderer: Renderer,
        pixels: &mut [[u8; 4]],
    ) -> Result<(), DrawError> {
        if let Drawing::Reference(model) = self {
            let exact = reference::render(frame, *model).picture;
            pixels.copy_from_slice(store_f64(&exact, frame.encoding()).pixels());
            return Ok(());
        }
        if let Some((variant, _)) = self.variant(frame, renderer) {
            let (width, height) = (frame.picture_width(), frame.picture_height());
            let picture = PictureMut::rgba8(pixels, width, height);
            variant.draw(frame, picture, DrawOptions::by(renderer))?;
        }
        Ok(())
    }

    /// Estimates the memory, in bytes, that [`Drawing::render`] takes beside the frame and the
    /// engine.
    #[doc(hidden)]
    pub fn memory_needed(&self, frame: &Frame) -> u64 {
        let samples = (frame.width() * frame.height()) as u64;
        let pixels = (frame.picture_width() * frame.picture_height()) as u64;
        let stored = 4;
        if let Drawing::Reference(_) = self {
            // The reference keeps the polygon, depth and gap of each sample; while it shades, there
            // are two copies.
            let filtered = if frame.samples() > 1 { 32 } else { 0 };
            (32 + 2 * (4 + 8 + 8)) * samples + (filtered + 2 * stored) * pixels
        } else {
            stored * pixels
        }
    }

    /// Draws `frame` before rounding: channels are linear, in 0..=1.
    ///
    /// # Errors
    /// As [`Variant::render_linear`].
    pub fn render_linear(
        &self,
        frame: &Frame,
        renderer: Renderer,
    ) -> Result<LinearPicture, DrawError> {
        match (self, self.variant(frame, renderer)) {
            (_, Some((variant, _))) => variant.render_linear_with(frame, renderer),
            (Drawing::Reference(model), None) => Ok(reference::render(frame, *model).to_linear()),
            (_, None) => unreachable!("only the reference is no method"),
        }
    }
}

impl FromStr for Drawing {
    type Err = NameError;

    fn from_str(text: &str) -> Result<Drawing, NameError> {
        let (name, rest) = text.split_once(':').unwrap_or((text, ""));
        match name {
            Drawing::AUTO if rest.is_empty() && !text.contains(':') => Ok(Drawing::Auto),
            Drawing::REFERENCE if rest.is_empty() => Ok(Drawing::Reference(Model::Phong)),
            Drawing::REFERENCE => {
                let model = rest.strip_prefix("model=").unwrap_or(rest);
                let found = Model::ALL.into_iter().find(|known| known.name() == model);
                let unknown = || NameError::Unknown {
                    kind: "closed form",
                    name: model.to_string(),
                    known: Model::ALL.map(Model::name).to_vec(),
                };
                found.map(Drawing::Reference).ok_or_else(unknown)
            }
            _ if MethodRow::named(name).is_some() => Ok(Drawing::Variant(Variant::parse(text)?)),
            _ => Err(NameError::Unknown {
                kind: "method",
                name: name.to_string(),
                known: METHODS
                    .iter()
                    .map(|method| method.info.name)
                    .chain([Drawing::AUTO, Drawing::REFERENCE])
                    .collect(),
            }),
        }
    }
}

impl fmt::Display for Drawing {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Drawing::Auto => f.write_str(Drawing::AUTO),
            Drawing::Reference(Model::Phong) => f.write_str(Drawing::REFERENCE),
            Drawing::Reference(model) => {
                f.write_str(&format!("{}:model={}", Drawing::REFERENCE, model.name()))
            }
            Drawing::Variant(variant) => variant.fmt(f),
        }
    }
}

/// Returns the background of `frame` in the levels that a picture file stores.
#[doc(hidden)]
pub fn stored_background(frame: &Frame) -> [f64; 3] {
    let level = |c: f32| match frame.encoding() {
        Encoding::Linear => quantise(c),
        Encoding::Srgb => quantise(srgb_encode(c)),
    };
    frame.background().map(|c| f64::from(level(c)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::string::String;

    #[test]
    fn every_drawing_is_read_from_its_own_name() {
        let variants = METHODS.iter().map(|row| Drawing::Variant(row.variant()));
        let models = Model::ALL.map(Drawing::Reference);
        for drawing in variants.chain(models).chain([Drawing::Auto]) {
            assert_eq!(drawing.to_string().parse(), Ok(drawing));
        }
        let short = "reference:phong".parse();
        assert_eq!(short, Ok(Drawing::Reference(Model::Phong)));
    }

    #[test]
    fn unknown_names_get_a_suggestion() {
        let said = |text: &str| -> String {
            let error = text.parse::<Drawing>().expect_err("unknown");
            error.to_string()
        };
        assert_eq!(
            said("referense"),
            "unknown method `referense`: did you mean `reference`?"
        );
        assert!(said("reference:model=phung").ends_with("did you mean `phong`?"));
        assert!(
            said("fast-phong:step=1").starts_with("method `fast-phong` has no parameter `step`")
        );
        assert!(said("auto:x").starts_with("unknown method"));
    }
}
