//! From a scene file to what decides which polygon is seen: hidden surfaces, clipping, samples.

use super::check::Check;
use super::diagnostics::SceneError;
use super::value::{Choice, Located, Origin};
use super::{SceneFile, VisibilityChoice};
use crate::scene::{
    Clipping, Culling, DepthBits, DepthBuffer, HiddenSurfaces, Interpolation, Scene,
};
use std::format;
use std::string::String;
use std::vec::Vec;

impl SceneFile {
    /// How hidden surfaces are found; a key that means nothing under the way chosen is worth a warning.
    pub(super) fn hidden_surfaces(
        &self,
        check: &Check,
        warnings: &mut Vec<String>,
    ) -> Result<HiddenSurfaces, SceneError> {
        let bits = self
            .depth_bits
            .as_ref()
            .map_or(Ok(DepthBits::default()), |given| depth_bits(given, check))?;
        let source = self
            .depth
            .as_ref()
            .map_or_else(Default::default, |given| given.value);
        let key = self
            .painter_key
            .as_ref()
            .map_or_else(Default::default, |given| given.value);
        let choice = self
            .visibility
            .as_ref()
            .map_or(VisibilityChoice::ZBuffer, |given| given.value);
        let given = [
            (
                "depth_bits",
                self.depth_bits.as_ref().map(|given| &given.origin),
                VisibilityChoice::ZBuffer,
            ),
            (
                "depth",
                self.depth.as_ref().map(|given| &given.origin),
                VisibilityChoice::ZBuffer,
            ),
            (
                "painter_key",
                self.painter_key.as_ref().map(|given| &given.origin),
                VisibilityChoice::Painter,
            ),
        ];
        for (key, origin, needs) in given {
            if let Some(origin) = origin.filter(|_| choice != needs) {
                let name = name(key, origin);
                warnings.push(format!(
                    "`{name}` means nothing without visibility = \"{}\"",
                    needs.word()
                ));
            }
        }
        let culls_back = self
            .cull
            .as_ref()
            .is_none_or(|given| given.value == Culling::Back);
        if let Some(Located { origin, .. }) = self
            .two_sided
            .as_ref()
            .filter(|given| given.value && culls_back)
        {
            let name = name("two_sided", origin);
            warnings.push(format!(
                "`{name}` means nothing with cull = \"back\": what is seen from behind is left out"
            ));
        }
        Ok(match choice {
            VisibilityChoice::ZBuffer => HiddenSurfaces::ZBuffer(DepthBuffer { bits, source }),
            VisibilityChoice::Painter => HiddenSurfaces::Painter(key),
            VisibilityChoice::DrawOrder => HiddenSurfaces::DrawOrder,
        })
    }

    /// What keeps polygons within the view: CS171's test goes with its interpolation only.
    pub(super) fn clipping(&self, check: &Check) -> Result<Clipping, SceneError> {
        let Some(given) = &self.clipping else {
            return Ok(Clipping::default());
        };
        match &self.interpolation {
            Some(Located {
                value: Interpolation::Perspective,
                origin,
            }) if given.value == Clipping::NdcCube => {
                let why = "expected interpolation = \"screen\" with \"ndc-cube\": corners behind the eye have no weight";
                Err(check.conflict("clipping", &given.origin, "interpolation", origin, why))
            }
            _ => Ok(given.value),
        }
    }

    /// Samples a pixel along each side of a picture of these sides.
    pub(super) fn samples(&self, sides: [u32; 2], check: &Check) -> Result<u32, SceneError> {
        let Some(given) = &self.image.samples else {
            return Ok(1);
        };
        let refused = |expected: String| {
            check.error(
                &given.origin,
                "image.samples",
                &format!("is {}", given.value),
                expected,
            )
        };
        let Some(samples) = u32::try_from(given.value)
            .ok()
            .filter(|samples| [1, 2, 4, 8].contains(samples))
        else {
            return Err(refused("expected 1, 2, 4 or 8".into()));
        };
        let longest = sides[0].max(sides[1]);
        if longest * samples > Scene::MAX_SIDE {
            let most = Scene::MAX_SIDE;
            return Err(refused(format!(
                "expected at most {most} samples a side, and there are {longest} pixels"
            )));
        }
        Ok(samples)
    }
}

/// The bits of the depth buffer.
fn depth_bits(given: &Located<i64>, check: &Check) -> Result<DepthBits, SceneError> {
    match given.value {
        16 => Ok(DepthBits::Sixteen),
        24 => Ok(DepthBits::TwentyFour),
        32 => Ok(DepthBits::ThirtyTwo),
        bits => Err(check.error(
            &given.origin,
            "depth_bits",
            &format!("is {bits}"),
            "expected 16, 24 or 32",
        )),
    }
}

/// What a user called the key: the flag, where one gave it.
fn name<'a>(key: &'a str, origin: &'a Origin) -> &'a str {
    match origin {
        Origin::Flag(flag) => flag,
        Origin::File(_) | Origin::Program => key,
    }
}
