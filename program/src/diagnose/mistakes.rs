//! The table of mistakes, one per line.
//!
//! Two mistakes exclude each other if they set the same choice of a [`Recipe`]. In a scene that
//! states this choice, it is not a mistake.

use super::recipe::*;
use alloc::borrow::{Cow, ToOwned};
use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;
use fastphong::scene::{Culling, Scene, SpecularGate};
use fastphong::shading::{METHODS, MethodRow};

/// A mistake that people make when they draw a scene.
#[derive(Clone)]
pub struct Mistake {
    /// The name in data and on the command line.
    pub id: Cow<'static, str>,
    /// The part of drawing that it belongs to.
    pub part: Part,
    /// The mistake, in a sentence.
    pub text: Cow<'static, str>,
    /// The remedy, in a sentence.
    pub fix: Cow<'static, str>,
    /// The section or equation of a lecture that explains it. If there is none: `pictures`,
    /// `scenes`, `methods` or `check` (the course's page *Check your own*).
    pub see: &'static str,
    how: How,
}

/// The way to make a mistake: set choices of a recipe, or draw by another method.
#[derive(Clone, Copy)]
enum How {
    Set(fn(&mut Recipe)),
    Method(u8),
}

impl Mistake {
    /// Makes this mistake in a recipe.
    pub fn set(&self, recipe: &mut Recipe) {
        match self.how {
            How::Set(set) => set(recipe),
            How::Method(method) => recipe.shading.rate = Rate::Method(method),
        }
    }

    /// Says where to read on: the section of a lecture and the chapter of the course, or a
    /// document.
    pub fn read_on(&self) -> String {
        let chapters = [
            ("L21 2", "2-uniform-shading"),
            ("L21 3", "3-gouraud-shading"),
            ("L21 4.1", "4.1-naive-phong-shading"),
            ("L21 1", "1-introduction"),
        ];
        let lecture = self
            .see
            .strip_suffix(".1")
            .filter(|see| *see == "L21 2" || *see == "L21 3")
            .unwrap_or(self.see);
        let chapter = chapters.iter().find(|(section, _)| *section == lecture);
        match (chapter, self.see) {
            (Some((_, chapter)), see) => format!("{see}; report/course/{chapter}.md"),
            (None, "scenes") => "scenes/README.md".to_owned(),
            (None, "check") => "report/course/check-your-own.md".to_owned(),
            (None, see @ ("pictures" | "methods")) => format!("docs/{see}.md"),
            (None, see) => format!("{see}; docs/lectures.md"),
        }
    }

    /// Returns the recipe of someone who makes all of `mistakes` where `base` is right. Returns
    /// `None` if two of them exclude each other, or if one is not a mistake in `scene`.
    pub fn all(mistakes: &[&Mistake], base: Recipe, scene: &Scene) -> Option<Recipe> {
        let mut recipe = base;
        for mistake in mistakes {
            let before = recipe;
            mistake.set(&mut recipe);
            recipe = recipe.of_scene(scene);
            if recipe == before {
                return None;
            }
        }
        // Mistakes that set the same choice do not commute.
        let mut reversed = base;
        for mistake in mistakes.iter().rev() {
            mistake.set(&mut reversed);
            reversed = reversed.of_scene(scene);
        }
        // The engine draws a method itself: switches of the light do not reach it.
        let is_by_method = matches!(recipe.shading.rate, Rate::Method(_));
        let light = |recipe: &Recipe| Shading {
            rate: Rate::Pixel,
            ..recipe.shading
        };
        let is_drawn = !is_by_method || light(&recipe) == light(&base);
        (recipe == reversed && is_drawn).then_some(recipe)
    }

    /// Returns the mistake of drawing by the method at `index` of the method table.
    fn of_method(index: usize, row: &MethodRow) -> Mistake {
        let (name, title) = (row.info.name, row.info.title);
        Mistake {
            id: format!("method-{name}").into(),
            part: Part::Rate,
            text: format!("The method `{name}` drew it: {title}.").into(),
            fix: format!("`fastphong explain {name}` says what it leaves out.").into(),
            see: "methods",
            how: How::Method(index as u8),
        }
    }
}

/// Returns a mistake for each method: drawing by this method.
pub fn methods() -> Vec<Mistake> {
    let all = METHODS.iter().enumerate();
    all.map(|(index, row)| Mistake::of_method(index, row))
        .collect()
}

/// The part of drawing that a mistake belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Part {
    /// The illumination model.
    Light,
    /// The points where light is computed, and the values that are interpolated.
    Rate,
    /// Vertex normals.
    Normals,
    /// The camera and the position on the picture.
    Camera,
    /// Polygons and hidden surfaces.
    Geometry,
    /// The levels of the file.
    Picture,
}

const fn mistake(
    id: &'static str,
    part: Part,
    text: &'static str,
    fix: &'static str,
    see: &'static str,
    set: fn(&mut Recipe),
) -> Mistake {
    Mistake {
        id: Cow::Borrowed(id),
        part,
        text: Cow::Borrowed(text),
        fix: Cow::Borrowed(fix),
        see,
        how: How::Set(set),
    }
}

/// All mistakes.
#[rustfmt::skip]
pub static MISTAKES: &[Mistake] = &[
    mistake("specular-missing", Part::Light, "Highlights are missing.", "Add I_p k_s (R·V)ⁿ.", "L21 2.1", |r| r.mixing.specular = SpecularUse::Missing),
    mistake("ambient-missing", Part::Light, "Ambient light is missing.", "Add I_a k_a once.", "L21 2.1", |r| r.mixing.ambient = AmbientUse::Missing),
    mistake("diffuse-missing", Part::Light, "Diffuse light is missing.", "Add I_p k_d (L·N).", "L21 2.1", |r| r.mixing.diffuse = DiffuseUse::Missing),
    mistake("light-reversed", Part::Light, "L points from the light to the surface.", "L points from the surface to the light.", "L21 2", |r| r.shading.light_sign = Sign::Negated),
    mistake("light-not-normalised", Part::Light, "L is not normalised.", "L = (light − P) / |light − P|.", "CS171 2", |r| r.shading.light_length = Length::Raw),
    mistake("other-highlight", Part::Light, "The highlight follows N·H where the scene has R·V (or the reverse), with the same exponent.", "Use the cosine that the scene names, or convert the exponent: n for R·V is about 4n for N·H.", "L21 2.1", |r| r.shading.highlight = Highlight::Other),
    mistake("reflection-reversed", Part::Light, "R points the wrong way.", "R = 2 (L·N) N − L; functions called reflect expect −L.", "L21 2", |r| r.shading.reflected = Reflected::Negated),
    mistake("first-light-only", Part::Light, "Only the first light is used.", "Add up the light of all lights.", "L21 2", |r| r.mixing.lights = LightUse::First),
    mistake("view-reversed", Part::Light, "V points from the eye to the surface.", "V points from the surface to the eye.", "L21 2", |r| r.shading.view_sign = Sign::Negated),
    mistake("reflection-without-2", Part::Light, "R lacks the factor 2.", "R = 2 (L·N) N − L.", "L21 2", |r| r.shading.reflected = Reflected::WithoutTwo),
    mistake("reflection-plus", Part::Light, "R adds L in place of subtracting it.", "R = 2 (L·N) N − L.", "L21 2", |r| r.shading.reflected = Reflected::Plus),
    mistake("light-x-reversed", Part::Light, "The x of lights has the wrong sign.", "Use the lights' coordinates unchanged: x points to the right.", "CS171 2", |r| r.shading.light_axes = Axes::NegatedX),
    mistake("light-y-reversed", Part::Light, "The y of lights has the wrong sign.", "Use the lights' coordinates unchanged: y points up.", "CS171 2", |r| r.shading.light_axes = Axes::NegatedY),
    mistake("light-z-reversed", Part::Light, "The z of lights has the wrong sign.", "Use the lights' coordinates unchanged: the axes are right-handed.", "CS171 2", |r| r.shading.light_axes = Axes::NegatedZ),
    mistake("light-z-up", Part::Light, "y and z of lights are exchanged.", "Use the lights' coordinates unchanged: y points up.", "CS171 2", |r| r.shading.light_axes = Axes::ZUp),
    mistake("light-in-view-space", Part::Light, "Lights are in the camera's space, not in the world's.", "Compute N, L and V in one space: transform lights with the camera, or leave everything in the world.", "CS171 3", |r| r.shading.light_space = LightSpace::Camera),
    mistake("position-as-direction", Part::Light, "The position of a light is used as its direction.", "L = (light − P) / |light − P|, from each point P.", "CS171 2", |r| r.shading.light_place = LightPlace::PositionsAreDirections),
    mistake("direction-as-position", Part::Light, "The direction of a light is used as its position.", "L is the stated direction, the same at every point.", "L21 1", |r| r.shading.light_place = LightPlace::DirectionsArePositions),
    mistake("falloff-missing", Part::Light, "Lights do not weaken with distance.", "Multiply each light by its falloff.", "CS171 2", |r| r.shading.falloff = FalloffUse::Missing),
    mistake("falloff-linear", Part::Light, "The falloff uses the distance r, not r².", "1 / (1 + k r²).", "CS171 2", |r| r.shading.falloff = FalloffUse::Linear),
    mistake("falloff-inverse-square", Part::Light, "Lights fall off with 1/r².", "Use the falloff that the scene states.", "CS171 2", |r| r.shading.falloff = FalloffUse::InverseSquare),
    mistake("falloff-inverse", Part::Light, "Lights fall off with 1/r.", "Use the falloff that the scene states.", "L5 Light Falloff", |r| r.shading.falloff = FalloffUse::Inverse),
    mistake("last-light-only", Part::Light, "Only the last light is used.", "Add up the light of all lights: your sum starts again for each.", "L21 2", |r| r.mixing.lights = LightUse::Last),
    mistake("direction-minus-eye", Part::Light, "Directions of lights are moved like points: L is the direction minus the eye.", "A direction has w = 0: the matrix turns it, and does not move it.", "CS171 2", |r| r.shading.light_place = LightPlace::DirectionsMinusEye),
    mistake("direction-minus-target", Part::Light, "Directions of lights are moved like points: L is the direction minus the target.", "A direction has w = 0: the matrix turns it, and does not move it.", "CS171 2", |r| r.shading.light_place = LightPlace::DirectionsMinusTarget),
    mistake("lights-averaged", Part::Light, "The sum of the lights is divided by how many there are.", "Add up the light of all lights.", "L21 2", |r| r.mixing.lights = LightUse::Mean),
    mistake("light-colour-missing", Part::Light, "Lights are white.", "Multiply diffuse and specular light by the light's colour I_p.", "L21 2.1", |r| r.mixing.light_colour = LightColour::White),
    mistake("highlight-white", Part::Light, "Highlights leave out the colour and strength I_p of the light.", "The specular term is I_p k_s (R·V)ⁿ.", "L21 2.1", |r| r.mixing.light_colour = LightColour::WhiteHighlights),
    mistake("viewer-distance", Part::Light, "The viewer is infinitely far away where the scene has it at the eye, or the reverse.", "V is one direction for a viewer at infinity, (eye − P) / |eye − P| for one at the eye.", "CS171 2", |r| r.shading.viewer = Viewer::Other),
    mistake("eye-as-direction", Part::Light, "V is the position of the eye, normalised.", "V = (eye − P) / |eye − P|, or the direction from the target to the eye.", "CS171 2", |r| r.shading.viewer = Viewer::EyeAsDirection),
    mistake("diffuse-absolute", Part::Light, "Surfaces that face away from a light are lit: |L·N|.", "The diffuse term is max(0, L·N).", "L21 2.1", |r| r.shading.cosine = Cosine::Absolute),
    mistake("diffuse-unclamped", Part::Light, "L·N is not clamped at 0: it takes light away where the surface faces away.", "The diffuse term is max(0, L·N).", "L21 2.1", |r| r.shading.cosine = Cosine::Signed),
    mistake("half-lambert", Part::Light, "The diffuse term is (L·N + 1)/2.", "The diffuse term is max(0, L·N).", "L21 2.1", |r| r.shading.cosine = Cosine::Half),
    mistake("highlight-unclamped", Part::Light, "R·V (or N·H) is not clamped at 0 before the power.", "max(0, R·V)ⁿ: an even power of a negative number is positive.", "L21 2.1", |r| r.shading.cap = Cap::Unclamped),
    mistake("highlight-behind", Part::Light, "Highlights appear where the light is behind the surface.", "No highlight where L·N ≤ 0.", "L21 2.1", |r| r.shading.gate = Some(SpecularGate::Ungated)),
    mistake("highlight-cut", Part::Light, "Highlights end where L·N = 0.", "Use the `specular_gate` that the scene states.", "CS171 2", |r| r.shading.gate = Some(SpecularGate::Gated)),
    mistake("highlight-times-cosine", Part::Light, "Highlights are multiplied by L·N.", "The specular term is I_p k_s (R·V)ⁿ.", "L21 2.1", |r| r.shading.gate = Some(SpecularGate::Weighted)),
    mistake("other-highlight-converted", Part::Light, "The highlight follows N·H where the scene has R·V (or the reverse), with a converted exponent.", "Use the cosine that the scene names.", "L21 2.1", |r| r.shading.highlight = Highlight::OtherConverted),
    mistake("halfway-not-normalised", Part::Light, "H is L + V, not normalised.", "H = (L + V) / |L + V|.", "CS171 2", |r| r.shading.halfway = Halfway::Sum),
    mistake("halfway-mean", Part::Light, "H is (L + V)/2, not normalised.", "H = (L + V) / |L + V|.", "CS171 2", |r| r.shading.halfway = Halfway::Mean),
    mistake("exponent-halved", Part::Light, "The exponent is half as large.", "(R·V)ⁿ with the n of the material.", "L21 2.1", |r| r.shading.exponent = Exponent::Half),
    mistake("exponent-doubled", Part::Light, "The exponent is twice as large.", "(R·V)ⁿ with the n of the material.", "L21 2.1", |r| r.shading.exponent = Exponent::Double),
    mistake("exponent-quartered", Part::Light, "The exponent is a quarter as large.", "(R·V)ⁿ with the n of the material.", "L21 2.1", |r| r.shading.exponent = Exponent::Quarter),
    mistake("exponent-fourfold", Part::Light, "The exponent is four times as large.", "(R·V)ⁿ with the n of the material; 4n is for N·H.", "L21 2.1", |r| r.shading.exponent = Exponent::Fourfold),
    mistake("exponent-missing", Part::Light, "R·V is not raised to the exponent.", "The specular term is I_p k_s (R·V)ⁿ.", "L21 2.1", |r| r.shading.exponent = Exponent::One),
    mistake("ambient-per-light", Part::Light, "Ambient light is added once for each light.", "Add I_a k_a once, outside the loop over lights.", "L21 2.1", |r| r.mixing.ambient = AmbientUse::PerLight),
    mistake("ambient-without-material", Part::Light, "Ambient light leaves out k_a.", "The ambient term is I_a k_a.", "L21 2.1", |r| r.mixing.ambient = AmbientUse::WithoutMaterial),
    mistake("ambient-without-light", Part::Light, "Ambient light leaves out I_a.", "The ambient term is I_a k_a.", "L21 2.1", |r| r.mixing.ambient = AmbientUse::WithoutLight),
    mistake("ambient-times-diffuse", Part::Light, "Ambient light is multiplied by the diffuse colour, too.", "The ambient term is I_a k_a.", "L21 2.1", |r| r.mixing.ambient = AmbientUse::TimesDiffuse),
    mistake("specular-times-diffuse", Part::Light, "Highlights are multiplied by the diffuse colour, too.", "The specular term is I_p k_s (R·V)ⁿ: k_d does not belong there.", "L21 2.1", |r| r.mixing.specular = SpecularUse::TimesDiffuse),
    mistake("specular-diffuse-colour", Part::Light, "Highlights have the diffuse colour k_d in place of k_s.", "The specular term is I_p k_s (R·V)ⁿ.", "L21 2.1", |r| r.mixing.specular = SpecularUse::DiffuseColour),
    mistake("specular-without-material", Part::Light, "Highlights leave out k_s.", "The specular term is I_p k_s (R·V)ⁿ.", "L21 2.1", |r| r.mixing.specular = SpecularUse::WithoutMaterial),
    mistake("clamped-per-light", Part::Light, "Each light is clamped before the sum.", "Clamp the sum once, at the end.", "L21 2", |r| r.mixing.sum = Sum::ClampedPerLight),
    mistake("light-colour-of-first", Part::Light, "All lights have the colour of the first one.", "Use the colour I_p of each light.", "L21 2.1", |r| r.mixing.light_colour = LightColour::OfFirst),
    mistake("lights-missing", Part::Light, "No light is used: there is ambient light only.", "Add up the light of all lights.", "L21 2", |r| r.mixing.lights = LightUse::None),
    mistake("light-white", Part::Light, "Lights are white, as strong as their strongest channel.", "Multiply diffuse and specular light by the light's colour I_p.", "L21 2.1", |r| r.mixing.light_colour = LightColour::WhiteOfStrength),
    mistake("one-material", Part::Light, "All polygons have the first material.", "Use the material of each polygon.", "L21 2.1", |r| r.shading.materials = MaterialUse::First),
    mistake("default-material", Part::Light, "No material was read: all polygons have fastphong's default material.", "Read the materials of the scene and of the mesh.", "L21 2.1", |r| r.shading.materials = MaterialUse::Default),
    mistake("falloff-multiplied", Part::Light, "Lights are multiplied by 1 + k r², not divided by it.", "1 / (1 + k r²).", "CS171 2", |r| r.shading.falloff = FalloffUse::Multiplied),
    mistake("falloff-diffuse-only", Part::Light, "Highlights do not weaken with distance.", "Multiply the highlight by the light's falloff, too.", "CS171 2", |r| r.shading.falloff = FalloffUse::DiffuseOnly),
    mistake("view-along-z", Part::Light, "V is (0, 0, 1), as if the camera looked along −z in the world.", "V is the direction from the target to the eye.", "L21 2", |r| r.shading.viewer = Viewer::AlongZ),
    mistake("view-toward-origin", Part::Light, "V is −P, as if the eye were at the origin.", "V = (eye − P) / |eye − P|; −P is right in the camera's space.", "CS171 2", |r| r.shading.viewer = Viewer::AtOrigin),
    mistake("view-not-normalised", Part::Light, "V is not normalised.", "V = (eye − P) / |eye − P|.", "CS171 2", |r| r.shading.view_length = Length::Raw),
    mistake("reflection-of-view", Part::Light, "R is 2 (N·V) N − L.", "R = 2 (L·N) N − L.", "L21 2", |r| r.shading.reflected = Reflected::OfView),
    mistake("halfway-difference", Part::Light, "H is the direction of L − V.", "H = (L + V) / |L + V|.", "CS171 2", |r| r.shading.halfway = Halfway::Difference),
    mistake("highlight-n-v", Part::Light, "The highlight follows N·V.", "The specular term is I_p k_s (R·V)ⁿ.", "L21 2.1", |r| r.shading.highlight = Highlight::NormalView),
    mistake("highlight-n-l", Part::Light, "The highlight follows N·L.", "The specular term is I_p k_s (R·V)ⁿ.", "L21 2.1", |r| r.shading.highlight = Highlight::NormalLight),
    mistake("exponent-times-128", Part::Light, "The exponent is 128 times as large.", "(R·V)ⁿ with the n of the material, which is not a share of 128.", "L21 2.1", |r| r.shading.exponent = Exponent::Times128),
    mistake("exponent-as-factor", Part::Light, "n is a factor, not an exponent.", "(R·V)ⁿ, a power.", "L21 2.1", |r| r.shading.exponent = Exponent::Factor),
    mistake("power-of-product", Part::Light, "k_s is inside the power: (k_s R·V)ⁿ.", "k_s (R·V)ⁿ.", "L21 2.1", |r| r.mixing.specular = SpecularUse::InsidePower),
    mistake("ambient-diffuse-colour", Part::Light, "Ambient light has k_d in place of k_a.", "The ambient term is I_a k_a.", "L21 2.1", |r| r.mixing.ambient = AmbientUse::DiffuseColour),
    mistake("ambient-with-falloff", Part::Light, "Ambient light is added for each light and weakens with the light's distance.", "Add I_a k_a once, outside the loop over lights.", "CS171 2", |r| r.mixing.ambient = AmbientUse::WithFalloff),
    mistake("lights-moved-to-view-space", Part::Light, "Lights are transformed into the camera's space, normals are not.", "Compute N, L and V in one space.", "CS171 3", |r| r.shading.light_space = LightSpace::Moved),
    mistake("light-positions-turned", Part::Light, "Positions of lights are rotated like the camera, and not moved.", "Transform positions with w = 1, or leave everything in the world.", "CS171 3", |r| r.shading.light_space = LightSpace::Turned),
    mistake("lights-by-inverse-rotation", Part::Light, "Lights are in the camera's space, and the inverse of its rotation is applied to them.", "Rotate lights and normals by the same matrix.", "CS171 3", |r| r.shading.light_space = LightSpace::Inverse),
    mistake("positions-in-view-space", Part::Light, "Positions are in the camera's space where L and V are computed, light and eye in the world's.", "Compute N, L and V in one space.", "CS171 3", |r| r.shading.position_space = Space::Camera),
    mistake("view-of-two-spaces", Part::Light, "V is the eye in the world's space minus the point in the camera's.", "V = (eye − P) / |eye − P|, both in one space.", "CS171 3", |r| r.shading.viewer = Viewer::OfTwoSpaces),
    mistake("view-of-unit-vectors", Part::Light, "V is the difference of the normalised eye and the normalised point.", "V = (eye − P) / |eye − P|: normalise last.", "CS171 2", |r| r.shading.viewer = Viewer::OfUnits),
    mistake("view-per-vertex", Part::Light, "V is normalised at vertices and interpolated.", "V = (eye − P) / |eye − P| at each pixel.", "CS171 2", |r| r.shading.view_rate = ViewRate::Vertex),
    mistake("light-xy-exchanged", Part::Light, "x and y of lights are exchanged.", "Use the lights' coordinates unchanged.", "CS171 2", |r| r.shading.light_axes = Axes::ExchangedXy),
    mistake("light-xz-exchanged", Part::Light, "x and z of lights are exchanged.", "Use the lights' coordinates unchanged.", "CS171 2", |r| r.shading.light_axes = Axes::ExchangedXz),
    mistake("halfway-of-unnormalised", Part::Light, "H is the sum of L and V before they are normalised.", "H = (L + V) / |L + V| with L and V of length 1.", "CS171 2", |r| r.shading.halfway = Halfway::OfDistances),
    mistake("halfway-constant", Part::Light, "H is computed once, from the direction of the light and of the eye.", "H = (L + V) / |L + V| at each point.", "CS171 2", |r| r.shading.halfway = Halfway::Constant),
    mistake("reflection-times-cosine", Part::Light, "R = 2 (L·N) (N − L): the factor belongs to N alone.", "R = 2 (L·N) N − L.", "L21 2", |r| r.shading.reflected = Reflected::TimesCosine),
    mistake("highlight-fresnel", Part::Light, "Highlights are multiplied by 1 − N·V.", "The specular term is I_p k_s (R·V)ⁿ.", "L21 2.1", |r| r.shading.fresnel = Fresnel::OneMinusCosine),
    mistake("highlight-tinted", Part::Light, "Highlights have the hue of k_d.", "The specular term is I_p k_s (R·V)ⁿ.", "L21 2.1", |r| r.mixing.specular = SpecularUse::Tinted),
    mistake("highlight-normalised", Part::Light, "Highlights are multiplied by (n + 2)/2π.", "The specular term is I_p k_s (R·V)ⁿ.", "L21 2.1", |r| r.mixing.specular = SpecularUse::Normalised),
    mistake("highlight-normalised-for-h", Part::Light, "Highlights are multiplied by (n + 8)/8π.", "The specular term is I_p k_s (R·V)ⁿ.", "L21 2.1", |r| r.mixing.specular = SpecularUse::NormalisedForHalfway),
    mistake("diffuse-over-pi", Part::Light, "The diffuse term is divided by π.", "The diffuse term is I_p k_d (L·N).", "L21 2.1", |r| r.mixing.diffuse = DiffuseUse::OverPi),
    mistake("diffuse-times-rest", Part::Light, "The diffuse term is multiplied by 1 − k_s.", "The diffuse term is I_p k_d (L·N).", "L21 2.1", |r| r.mixing.diffuse = DiffuseUse::TimesRest),
    mistake("diffuse-wrapped", Part::Light, "The diffuse term is (L·N + ½)/1.5, which lights surfaces that face away.", "The diffuse term is max(0, L·N).", "L21 2.1", |r| r.shading.cosine = Cosine::Wrapped),
    mistake("diffuse-squared", Part::Light, "L·N is squared.", "The diffuse term is max(0, L·N).", "L21 2.1", |r| r.shading.cosine = Cosine::Squared),
    mistake("diffuse-of-angle", Part::Light, "The diffuse term falls with the angle between L and N, not with its cosine.", "The diffuse term is max(0, L·N).", "L21 2.1", |r| r.shading.cosine = Cosine::Angle),
    mistake("diffuse-in-steps", Part::Light, "L·N has four steps, cut off, as in cartoons.", "The diffuse term is max(0, L·N).", "L21 2.1", |r| r.shading.cosine = Cosine::StepsDown),
    mistake("diffuse-in-steps-up", Part::Light, "L·N has four steps, rounded up, as in cartoons.", "The diffuse term is max(0, L·N).", "L21 2.1", |r| r.shading.cosine = Cosine::StepsUp),
    mistake("mixed-not-added", Part::Light, "Highlights cover diffuse light: mix(diffuse, colour, highlight).", "Add the terms.", "L21 2.1", |r| r.mixing.sum = Sum::Mixed),
    mistake("ambient-as-floor", Part::Light, "Ambient light is the least colour: max(ambient, the rest).", "Add I_a k_a.", "L21 2.1", |r| r.mixing.sum = Sum::AmbientAsFloor),
    mistake("diffuse-or-highlight", Part::Light, "Only the larger of diffuse and specular light counts.", "Add both terms.", "L21 2.1", |r| r.mixing.sum = Sum::LargerTerm),
    mistake("per-vertex", Part::Rate, "Vertices are lit, and their colours are interpolated: Gouraud shading.", "Interpolate normals, and light each pixel.", "L21 3", |r| r.shading.rate = Rate::Vertex),
    mistake("per-face", Part::Rate, "Each polygon has one colour, lit by its own normal.", "Light each pixel, with the interpolated normal.", "L21 2", |r| r.shading.rate = Rate::Face),
    mistake("normals-not-normalised", Part::Rate, "Interpolated normals are not normalised at the pixels.", "N / |N| at each pixel, after the interpolation.", "L21 4.1", |r| r.shading.normal_length = Length::Raw),
    mistake("normals-not-normalised-but-r", Part::Rate, "Interpolated normals are not normalised at the pixels; only R is.", "N / |N| at each pixel, after the interpolation.", "L21 4.1", |r| { r.shading.normal_length = Length::Raw; r.shading.reflected = Reflected::Normalised; }),
    mistake("per-face-mean", Part::Rate, "Each polygon has one colour, lit by the mean of its vertex normals.", "Light each pixel, with the interpolated normal.", "CS171 3", |r| r.shading.rate = Rate::FaceMean),
    mistake("per-face-first-vertex", Part::Rate, "Each polygon has the colour of its first vertex.", "Light each pixel, with the interpolated normal.", "L21 4.1", |r| r.shading.rate = Rate::FirstVertex),
    mistake("per-vertex-unclamped", Part::Rate, "Vertices are lit, and their colours are interpolated without a clamp at the vertices.", "Interpolate normals, and light each pixel.", "L21 3", |r| r.shading.rate = Rate::VertexUnclamped),
    mistake("per-pixel", Part::Rate, "Each pixel is lit, with the interpolated normal: Phong shading.", "Light as the exercise asks.", "L21 4.1", |r| r.shading.rate = Rate::Pixel),
    mistake("constant-vectors", Part::Rate, "L and V are constant over each polygon.", "Compute L and V at each pixel if the light or the viewer has a position.", "L21 1", |r| r.shading.rate = Rate::ConstantVectors),
    mistake("other-interpolation", Part::Rate, "Values are interpolated linearly on the screen where the scene asks for perspective, or the reverse.", "Under perspective: interpolate A/w and 1/w, and divide.", "L5 Interpolation Across Triangles", |r| r.geometry.interpolation = Interpolated::Other),
    mistake("normals-not-normalised-in-highlights", Part::Rate, "Interpolated normals are normalised for the diffuse term, but not for highlights.", "N / |N| at each pixel, for both terms.", "L21 4.1", |r| r.shading.highlight_normal = Length::Raw),
    mistake("interpolation-times-w", Part::Rate, "Interpolated values are multiplied by w where perspective divides by it.", "Interpolate A/w and 1/w, and divide.", "L5 Interpolation Across Triangles", |r| r.geometry.interpolation = Interpolated::TimesW),
    mistake("weights-of-next-corner", Part::Rate, "Each barycentric coordinate is assigned to the next corner of its triangle.", "The coordinate of a corner is the area opposite to it.", "L21 3", |r| { r.geometry.weights = Corners::Next; if r.geometry.cut == Cut::Whole { r.geometry.cut = Cut::Fan } }),
    mistake("weights-of-corner-before", Part::Rate, "Each barycentric coordinate is assigned to the previous corner of its triangle.", "The coordinate of a corner is the area opposite to it.", "L21 3", |r| { r.geometry.weights = Corners::Before; if r.geometry.cut == Cut::Whole { r.geometry.cut = Cut::Fan } }),
    mistake("normals-reversed", Part::Normals, "Normals point inward.", "Negate them: corners run counter-clockwise seen from outside.", "L21 1.1", |r| r.shading.normal_sign = Sign::Negated),
    mistake("normals-of-faces", Part::Normals, "Corners have the normal of their polygon, which is not averaged.", "Average the unit normals of all polygons around a vertex.", "L21 3.1", |r| r.shading.normals = Normals::OfFaces),
    mistake("normals-by-area", Part::Normals, "Vertex normals are averages weighted by the area of polygons.", "Normalise each polygon's normal before the sum.", "L21 3.1", |r| r.shading.normals = Normals::ByArea),
    mistake("normals-by-angle", Part::Normals, "Vertex normals are averages weighted by the angle at the vertex.", "The sum of L21 3.1 has no weights.", "L21 3.1", |r| r.shading.normals = Normals::ByAngle),
    mistake("normals-over-position", Part::Normals, "Normals of the file, or a crease, are ignored: all polygons at a position are averaged.", "Use the normals that the scene names.", "L21 3.1", |r| r.shading.normals = Normals::OverPosition),
    mistake("normals-sums", Part::Normals, "Averaged normals are not normalised before they are interpolated.", "Divide the sum by its length.", "L21 3.1", |r| r.shading.normals = Normals::Sums),
    mistake("normals-by-matrix", Part::Normals, "Normals are transformed by the matrix of the positions.", "Use the inverse transpose.", "CS171 2", |r| r.shading.normals = Normals::ByMatrix),
    mistake("normals-of-model", Part::Normals, "Normals are not transformed.", "Transform normals by the inverse transpose.", "CS171 2", |r| r.shading.normals = Normals::OfModel),
    mistake("normals-inside-out", Part::Normals, "Normals of a mirrored object point inward.", "A mirroring matrix turns polygons around: negate the normals.", "L21 1.1", |r| r.shading.normals = Normals::InsideOut),
    mistake("normals-toward-viewer", Part::Normals, "Normals are turned toward the viewer.", "Leave normals unchanged, unless the scene is two-sided.", "CS171 3", |r| r.shading.facing = Facing::TowardViewer),
    mistake("one-sided", Part::Normals, "Back sides are lit with the normals of the front.", "Negate the normal of polygons that are seen from behind.", "CS171 3", |r| r.shading.facing = Facing::OneSided),
    mistake("normals-by-index", Part::Normals, "Vertices that the file states twice, at one position, are averaged apart.", "Average over all polygons at a position, not at an index.", "L21 3.1", |r| r.shading.normals = Normals::ByIndex),
    mistake("face-normals-not-normalised", Part::Normals, "Normals of polygons are not normalised: they are as long as twice the area.", "Divide Newell's sum by its length.", "L21 1.1", |r| { r.shading.normals = Normals::OfFacesRaw; r.shading.normal_length = Length::Raw }),
    mistake("normals-of-file", Part::Normals, "Normals of the file are used where the scene asks for averages.", "Average the unit normals of all polygons around a vertex.", "L21 3.1", |r| r.shading.normals = Normals::OfFile),
    mistake("normals-of-last-polygon", Part::Normals, "Each vertex has the normal of its last polygon.", "Add the normals of all polygons around a vertex: +=, not =.", "L21 3.1", |r| r.shading.normals = Normals::OfLastPolygon),
    mistake("normals-of-first-edges", Part::Normals, "Normals of polygons come from their first two edges.", "Newell's formula uses all edges.", "L21 1.1", |r| r.shading.normals = Normals::OfFirstEdges),
    mistake("normals-of-triangles", Part::Normals, "Normals are averaged over triangles: polygons that are cut count twice at some corners.", "Average the normals of whole polygons.", "L21 3.1", |r| r.shading.normals = Normals::OfTriangles),
    mistake("normals-by-inverse", Part::Normals, "Normals are transformed by the inverse matrix, which is not transposed.", "Use the inverse transpose.", "CS171 2", |r| r.shading.normals = Normals::ByInverse),
    mistake("normals-as-points", Part::Normals, "Normals are transformed like points: the translation is added to them.", "Use w = 0 for directions.", "CS171 2", |r| r.shading.normals = Normals::AsPoints),
    mistake("normals-in-view-space", Part::Normals, "Normals are in the camera's space, light and viewer in the world's.", "Compute N, L and V in one space.", "CS171 3", |r| r.shading.normal_space = Space::Camera),
    mistake("normals-x-negated", Part::Normals, "The x of normals has the wrong sign.", "Use the mesh's axes unchanged.", "L21 1.1", |r| r.shading.normal_axes = Axes::NegatedX),
    mistake("normals-y-negated", Part::Normals, "The y of normals has the wrong sign.", "Use the mesh's axes unchanged.", "L21 1.1", |r| r.shading.normal_axes = Axes::NegatedY),
    mistake("normals-z-negated", Part::Normals, "The z of normals has the wrong sign.", "Use the mesh's axes unchanged.", "L21 1.1", |r| r.shading.normal_axes = Axes::NegatedZ),
    mistake("normals-yz-exchanged", Part::Normals, "y and z of normals are exchanged.", "Use the mesh's axes unchanged.", "L21 1.1", |r| r.shading.normal_axes = Axes::ZUp),
    mistake("normals-xy-exchanged", Part::Normals, "x and y of normals are exchanged.", "Use the mesh's axes unchanged.", "L21 1.1", |r| r.shading.normal_axes = Axes::ExchangedXy),
    mistake("normals-xz-exchanged", Part::Normals, "x and z of normals are exchanged.", "Use the mesh's axes unchanged.", "L21 1.1", |r| r.shading.normal_axes = Axes::ExchangedXz),
    mistake("normals-not-decoded", Part::Normals, "Normals are (N + 1)/2, as textures store them.", "N = 2 c − 1 for a stored colour c.", "L21 4.1", |r| r.shading.normals = Normals::Halved),
    mistake("normals-of-vertex-before", Part::Normals, "Each vertex has the normal of the vertex before it.", "OBJ files count from 1.", "L21 3.1", |r| r.shading.normals = Normals::OfVertexBefore),
    mistake("normals-of-vertex-after", Part::Normals, "Each vertex has the normal of the next one.", "OBJ files count from 1.", "L21 3.1", |r| r.shading.normals = Normals::OfVertexAfter),
    mistake("normals-are-positions", Part::Normals, "The normal is the direction from the middle of the object.", "Average the unit normals of all polygons around a vertex: only a sphere's normals are its positions.", "L21 3.1", |r| r.shading.normals = Normals::Positions),
    mistake("w-in-normals", Part::Normals, "Normals keep a fourth component after the view matrix, and are divided by the length of all four.", "Use w = 0 for directions, and drop it before you normalise.", "CS171 2", |r| r.shading.normal_w = NormalW::OfTarget),
    mistake("w-of-eye-in-normals", Part::Normals, "Normals keep a fourth component, N times the eye, and are divided by the length of all four.", "Use w = 0 for directions, and drop it before you normalise.", "CS171 2", |r| r.shading.normal_w = NormalW::OfEye),
    mistake("upside-down", Part::Camera, "The picture is upside down.", "Row 0 is the top row: y = (1 − y_ndc)/2 · height.", "check", |r| r.place.turn = Turn::MirroredY),
    mistake("fov-in-radians", Part::Camera, "The field of view in degrees is used as radians.", "Multiply by π/180 before the tangent.", "scenes", |r| r.geometry.lens = Lens::Degrees),
    mistake("fov-whole-in-radians", Part::Camera, "tan(fovy) is computed with degrees used as radians.", "tan(fovy/2 · π/180).", "scenes", |r| r.geometry.lens = Lens::WholeDegrees),
    mistake("fov-halved", Part::Camera, "The field of view is half as large.", "`fovy` is the whole vertical angle; `half_height` half of the height.", "scenes", |r| r.geometry.lens = Lens::Half),
    mistake("fov-doubled", Part::Camera, "The field of view is twice as large: tan(fovy) in place of tan(fovy/2).", "tan(fovy/2).", "scenes", |r| r.geometry.lens = Lens::Double),
    mistake("fov-horizontal", Part::Camera, "The vertical field of view is used as the horizontal one.", "Divide x, not y, by the aspect ratio.", "scenes", |r| r.geometry.lens = Lens::Horizontal),
    mistake("other-projection", Part::Camera, "The picture is orthographic where the scene has perspective, or the reverse.", "Use the projection that the scene states.", "scenes", |r| r.geometry.lens = Lens::OtherProjection),
    mistake("eye-behind-by-focal-length", Part::Camera, "The centre of projection lies behind the eye, by the focal length: w = 1 − z/f for a view matrix that begins at the eye.", "Divide by w = −z/f of the point in the camera's space, whose origin is the eye.", "scenes", |r| r.geometry.eye = Eye::BehindByFocalLength),
    mistake("eye-behind", Part::Camera, "The centre of projection lies behind the eye, as far as the target is in front of it.", "Divide by w = −z of the point in the camera's space, whose origin is the eye.", "scenes", |r| r.geometry.eye = Eye::Behind),
    mistake("aspect-missing", Part::Camera, "The aspect ratio is left out: everything is stretched in x.", "Divide x by width/height.", "scenes", |r| r.geometry.aspect = Aspect::Missing),
    mistake("aspect-inverted", Part::Camera, "x is multiplied by the aspect ratio, not divided by it.", "Divide x by width/height.", "scenes", |r| r.geometry.aspect = Aspect::Inverted),
    mistake("mirrored-x", Part::Camera, "The picture is mirrored: left and right are exchanged.", "x grows to the right: check the cross product that makes the camera's right.", "scenes", |r| r.place.turn = Turn::MirroredX),
    mistake("turned", Part::Camera, "The picture is turned by half a circle.", "x grows to the right, y upward: check the sign of the focal length.", "check", |r| r.place.turn = Turn::Half),
    mistake("half-pixel-off", Part::Camera, "Pixels are sampled at their corners, not at their centres.", "The centre of pixel x is x + ½.", "check", |r| r.geometry.halves = [1, 1]),
    mistake("half-pixel-off-back", Part::Camera, "Everything is half a pixel too far to the left and up.", "The centre of pixel x is x + ½.", "check", |r| r.geometry.halves = [-1, -1]),
    mistake("half-pixel-off-x", Part::Camera, "Everything is half a pixel too far to the left.", "The centre of pixel x is x + ½.", "check", |r| r.geometry.halves = [-1, 0]),
    mistake("half-pixel-off-y", Part::Camera, "Everything is half a pixel too far up.", "The centre of pixel y is y + ½.", "check", |r| r.geometry.halves = [0, -1]),
    mistake("half-pixel-off-x-right", Part::Camera, "Everything is half a pixel too far to the right.", "The centre of pixel x is x + ½.", "check", |r| r.geometry.halves = [1, 0]),
    mistake("half-pixel-off-y-down", Part::Camera, "Everything is half a pixel too far down.", "The centre of pixel y is y + ½.", "check", |r| r.geometry.halves = [0, 1]),
    mistake("half-pixel-off-flipped", Part::Camera, "Everything is half a pixel too far to the right and up.", "The centre of pixel x is x + ½.", "check", |r| r.geometry.halves = [1, -1]),
    mistake("half-pixel-off-flipped-back", Part::Camera, "Everything is half a pixel too far to the left and down.", "The centre of pixel x is x + ½.", "check", |r| r.geometry.halves = [-1, 1]),
    mistake("pixel-off-left", Part::Camera, "Everything is a pixel too far to the left.", "Pixels go from 0 to width − 1.", "check", |r| r.place.moved = [-1, 0]),
    mistake("pixel-off-right", Part::Camera, "Everything is a pixel too far to the right.", "Pixels go from 0 to width − 1.", "check", |r| r.place.moved = [1, 0]),
    mistake("pixel-off-up", Part::Camera, "Everything is a pixel too far up.", "Rows go from 0 to height − 1.", "check", |r| r.place.moved = [0, -1]),
    mistake("pixel-off-down", Part::Camera, "Everything is a pixel too far down.", "Rows go from 0 to height − 1.", "check", |r| r.place.moved = [0, 1]),
    mistake("pixel-off-left-up", Part::Camera, "Everything is a pixel too far to the left and up.", "Pixels go from 0 to width − 1.", "check", |r| r.place.moved = [-1, -1]),
    mistake("pixel-off-right-down", Part::Camera, "Everything is a pixel too far to the right and down.", "Pixels go from 0 to width − 1.", "check", |r| r.place.moved = [1, 1]),
    mistake("pixel-off-right-up", Part::Camera, "Everything is a pixel too far to the right and up.", "Pixels go from 0 to width − 1.", "check", |r| r.place.moved = [1, -1]),
    mistake("pixel-off-left-down", Part::Camera, "Everything is a pixel too far to the left and down.", "Pixels go from 0 to width − 1.", "check", |r| r.place.moved = [-1, 1]),
    mistake("aspect-on-height", Part::Camera, "y is divided by the aspect ratio, not x.", "Divide x by width/height.", "scenes", |r| r.geometry.aspect = Aspect::OnHeight),
    mistake("viewport-less-one", Part::Camera, "The picture goes from 0 to width − 1 and height − 1.", "x = (x_ndc + 1)/2 · width.", "check", |r| r.geometry.corners = Snapping::LessOne),
    mistake("viewport-less-one-sampled-there", Part::Camera, "The picture goes from 0 to width − 1 and height − 1, and pixels are sampled at their corners.", "x = (x_ndc + 1)/2 · width; the centre of pixel x is x + ½.", "check", |r| r.geometry.corners = Snapping::LessOneAtCorners),
    mistake("columns-as-rows", Part::Camera, "The picture is stored column by column, and read row by row.", "Pixel x of row y is at y · width + x.", "pictures", |r| r.place.turn = Turn::Columns),
    mistake("transposed", Part::Camera, "x and y are exchanged.", "Pixel x of row y is at y · width + x.", "pictures", |r| r.place.turn = Turn::Transposed),
    mistake("cull-none", Part::Geometry, "Back faces are drawn.", "Leave out polygons whose corners run clockwise on the screen.", "CS171 4", |r| r.geometry.culling = Some(Culling::None)),
    mistake("cull-back", Part::Geometry, "Back faces are left out.", "The scene draws them: `cull = \"none\"`.", "CS171 4", |r| r.geometry.culling = Some(Culling::Back)),
    mistake("cull-front", Part::Geometry, "Front faces are left out.", "Corners run counter-clockwise seen from the front.", "CS171 4", |r| r.geometry.culling = Some(Culling::Front)),
    mistake("depth-reversed", Part::Geometry, "The farthest surface is visible, not the nearest.", "Draw a pixel where its depth is less than the stored one, which begins at the far plane.", "CS171 4", |r| r.geometry.depth = Depth::Reversed),
    mistake("depth-missing", Part::Geometry, "There is no depth test: later polygons hide earlier ones.", "Compare depth at each pixel.", "CS171 4", |r| r.geometry.depth = Depth::LastInFile),
    mistake("depth-first", Part::Geometry, "Earlier polygons hide later ones, whatever their depth.", "Store depth where a pixel is drawn, and compare with it.", "CS171 4", |r| r.geometry.depth = Depth::FirstInFile),
    mistake("near-left-out", Part::Geometry, "Polygons that reach in front of the near plane are left out.", "Cut them at the near plane.", "scenes", |r| r.geometry.near = Near::LeftOut),
    mistake("near-not-cut", Part::Geometry, "Polygons are not cut at the near plane before the division by w.", "Cut them at the near plane.", "scenes", |r| r.geometry.near = Near::Divided),
    mistake("fan-of-concave", Part::Geometry, "Concave polygons are cut into a fan, which reaches outside of them.", "Cut ears, or fill between pairs of edges.", "L21 3", |r| r.geometry.cut = Cut::FanOfConcave),
    mistake("fan-without-last", Part::Geometry, "The last triangle of each polygon is missing.", "A polygon of n corners is n − 2 triangles.", "L21 3", |r| r.geometry.cut = Cut::FanWithoutLast),
    mistake("first-triangle", Part::Geometry, "Only the first triangle of each polygon is drawn.", "A polygon of n corners is n − 2 triangles.", "L21 3", |r| r.geometry.cut = Cut::FirstTriangle),
    mistake("cull-none-depth-missing", Part::Geometry, "Back faces are drawn, and there is no depth test.", "Leave out back faces, and compare depth at each pixel.", "CS171 4", |r| { r.geometry.culling = Some(Culling::None); r.geometry.depth = Depth::LastInFile }),
    mistake("corners-on-whole-pixels", Part::Geometry, "Corners are rounded to whole pixels.", "Keep fractions of a pixel.", "check", |r| r.geometry.corners = Snapping::WholePixels),
    mistake("corners-cut-and-sampled-there", Part::Geometry, "Corners are cut down to whole pixels, and pixels are sampled there.", "Keep fractions of a pixel; the centre of pixel x is x + ½.", "check", |r| r.geometry.corners = Snapping::CutDownAtCorners),
    mistake("corners-cut", Part::Geometry, "Corners are cut down to whole pixels.", "Keep fractions of a pixel.", "check", |r| r.geometry.corners = Snapping::CutDown),
    mistake("corners-rounded-and-sampled-there", Part::Geometry, "Corners are rounded to whole pixels, and pixels are sampled there.", "Keep fractions of a pixel; the centre of pixel x is x + ½.", "check", |r| r.geometry.corners = Snapping::WholePixelsAtCorners),
    mistake("mirrored-inside", Part::Geometry, "Mirrored objects show their inside.", "A mirroring matrix turns polygons around: leave out the other side.", "CS171 4", |r| r.geometry.mirrored = Mirrored::Inside),
    mistake("depth-of-polygons", Part::Geometry, "Each polygon has one depth, the mean of its corners.", "Interpolate depth at each pixel.", "CS171 4", |r| r.geometry.depth = Depth::OfPolygons),
    mistake("depth-ties-to-last", Part::Geometry, "Among equally near polygons the last one is visible.", "Draw a pixel only where its depth is less than the stored one.", "CS171 4", |r| r.geometry.depth = Depth::TiesToLast),
    mistake("triangle-strip", Part::Geometry, "Polygons are cut into a strip of triangles, 0 1 2 and 1 2 3.", "A fan: 0 1 2 and 0 2 3.", "L21 3", |r| r.geometry.cut = Cut::Strip),
    mistake("encoded-srgb", Part::Picture, "Linear light is encoded as sRGB, which the scene does not ask for.", "Store round(255 c).", "pictures", |r| r.storage.curve = Curve::Srgb),
    mistake("not-encoded", Part::Picture, "Linear light is stored where the scene asks for sRGB.", "Encode each channel before rounding.", "pictures", |r| r.storage.curve = Curve::Linear),
    mistake("truncated", Part::Picture, "Levels are cut off, not rounded.", "⌊255 c + ½⌋.", "pictures", |r| r.storage.rounding = Rounding::Down),
    mistake("rounded-up", Part::Picture, "Levels are rounded up.", "⌊255 c + ½⌋.", "pictures", |r| r.storage.rounding = Rounding::Up),
    mistake("encoded-twice", Part::Picture, "sRGB's curve is applied twice.", "Encode once: many libraries encode when they write the file.", "pictures", |r| r.storage.curve = Curve::SrgbTwice),
    mistake("decoded", Part::Picture, "sRGB's curve is applied backward: the picture is too dark.", "Encode linear light, do not decode it.", "pictures", |r| r.storage.curve = Curve::Decoded),
    mistake("power-2.2", Part::Picture, "Colours are raised to the power 1/2.2.", "Use the encoding that the scene states.", "pictures", |r| r.storage.curve = Curve::Power),
    mistake("power-2.2-backward", Part::Picture, "Colours are raised to the power 2.2.", "Use the encoding that the scene states.", "pictures", |r| r.storage.curve = Curve::InversePower),
    mistake("bgr", Part::Picture, "Red and blue are exchanged.", "Write red, green, blue.", "pictures", |r| r.storage.channels = Channels::Bgr),
    mistake("grey", Part::Picture, "The picture has no colours.", "Compute all three channels.", "L21 2", |r| r.storage.channels = Channels::Grey),
    mistake("grey-levels", Part::Picture, "The picture has no colours: each level is the mean of three, cut off.", "Compute all three channels.", "L21 2", |r| r.storage.channels = Channels::GreyOfLevels),
    mistake("red-green-exchanged", Part::Picture, "Red and green are exchanged.", "Write red, green, blue.", "pictures", |r| r.storage.channels = Channels::Grb),
    mistake("green-blue-exchanged", Part::Picture, "Green and blue are exchanged.", "Write red, green, blue.", "pictures", |r| r.storage.channels = Channels::Rbg),
    mistake("times-256", Part::Picture, "Levels are ⌊256 c⌋.", "⌊255 c + ½⌋.", "pictures", |r| r.storage.rounding = Rounding::Of256),
    mistake("wrapped", Part::Picture, "Colours over 1 wrap around to black.", "Clamp each channel to 0..1 before it becomes a byte.", "L21 2", |r| r.storage.range = LevelRange::Wrapped),
    mistake("stretched", Part::Picture, "All colours are stretched until the brightest is white.", "Store round(255 c): do not normalise the picture.", "pictures", |r| r.storage.range = LevelRange::Stretched),
    mistake("times-256-wrapped", Part::Picture, "Levels are ⌊256 c⌋, and white becomes black.", "⌊255 c + ½⌋.", "pictures", |r| r.storage.rounding = Rounding::Of256Wrapped),
    mistake("divided-by-largest", Part::Picture, "Colours over 1 are divided by their largest channel.", "Clamp each channel to 0..1.", "L21 2", |r| r.storage.range = LevelRange::ByLargest),
    mistake("tone-mapped", Part::Picture, "Colours are tone-mapped: c / (1 + c).", "Store round(255 c).", "L21 2", |r| r.storage.range = LevelRange::ToneMapped),
];
