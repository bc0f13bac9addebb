//! The mistakes: what each student did wrong, in one sentence, and how the renderer does it.
//!
//! They come from the lectures (where these leave something out, or where a sentence is easily
//! misread), and from public trackers and tutorials; the addresses stand above the rows.

use crate::options::*;

/// A mistake.
pub struct Mistake {
    /// A short name.
    pub id: &'static str,
    /// What the student did wrong.
    pub what: &'static str,
    /// The step that the student did wrong: a field of [`Options`].
    pub step: &'static str,
    /// Does that step wrong.
    pub make: fn(&mut Options),
}

macro_rules! mistakes {
    ($($id:literal $step:ident = $way:path, $what:literal;)*) => {
        /// All mistakes.
        pub static MISTAKES: &[Mistake] = &[$(Mistake {
            id: $id,
            what: $what,
            step: stringify!($step),
            make: |options| options.$step = $way,
        }),*];
    };
}

/// True if the same student can make both mistakes: they do different steps wrong.
///
/// One may still hide the other in a scene, as a missing specular term hides a wrong exponent: see
/// [`crate::draw::both_show`].
pub fn can_be_combined(a: &Mistake, b: &Mistake) -> bool {
    a.step != b.step
}

mistakes! {
    // --- Light vectors ---------------------------------------------------------------------

    // https://github.com/ggambetta/computer-graphics-from-scratch/issues/26
    // https://github.com/jian-ru/laugh_engine/issues/1
    "light-negated" light_direction = LightDirection::FromLight,
        "Used the direction in which light travels instead of the vector toward the light: dot(n, -l).";
    // https://github.com/daniilidis-group/neural_renderer/issues/102
    "light-position-alone" light_direction = LightDirection::PositionAlone,
        "Used a light's position as the vector toward it: l = normalize(light.position), without subtracting the point.";
    "light-from-object-origin" light_direction = LightDirection::FromObjectOrigin,
        "Computed the vector toward a light once per object, from the object's origin.";
    // https://github.com/Azalea8/Games101_Homework/pull/1
    "light-not-unit" light_length = LightLength::NotNormalised,
        "Forgot to normalise the vector toward a light: l = light.position - p.";
    // https://github.com/JoeyDeVries/LearnOpenGL/issues/394
    "light-by-model-matrix" light_space = LightSpace::Object,
        "Multiplied the lights by the model matrix too, so they turn and move with each object.";
    // https://github.com/SaschaWillems/Vulkan/issues/1033
    "light-in-eye-space" light_space = LightSpace::Eye,
        "Read the lights of the scene as if they were in the camera's space, where they move with it.";

    // https://github.com/facebookincubator/momentum/pull/1571
    "light-by-inverse-rotation" light_space = LightSpace::EyeTurnedBackTwice,
        "Rotated normals to the camera's space, and lights, which are in world space, by the inverse of that rotation.";
    "light-moved-to-eye-space" light_space = LightSpace::MovedToEye,
        "Transformed the lights by the view matrix, and left normals, points and eye in world space.";
    "light-xy-exchanged" light_axes = LightAxes::XyExchanged,
        "Exchanged x and y of the lights.";
    "light-xz-exchanged" light_axes = LightAxes::XzExchanged,
        "Exchanged x and z of the lights.";
    "points-in-eye-space" position_space = PositionSpace::Eye,
        "Passed points in the camera's space to the light, with the positions of lights and eye in world space.";

    // --- Materials -------------------------------------------------------------------------

    "coefficients-swapped" coefficients = Coefficients::Swapped,
        "Swapped kd and ks.";
    // https://medium.com/@Jacob_Bell/programmers-guide-to-gamma-correction-4c1d3a1724fb
    "coefficients-decoded" coefficients = Coefficients::Decoded,
        "Read the materials' colours as sRGB and decoded them: pow(k, 2.2).";
    "materials-first-of-mesh" materials = Materials::FirstOfMesh,
        "Ignored usemtl: the whole mesh has the first material of its file.";
    "materials-of-first-object" materials = Materials::OfFirstObject,
        "Set the material once, before the loop over objects: all have the first object's material.";

    // --- Light colours and sums ------------------------------------------------------------

    "light-colour-ignored" light_colour = LightColour::White,
        "Left out the lights' colours and intensities: every light is white.";
    "light-colour-of-first" light_colour = LightColour::OfFirstLight,
        "Used lights[0].colour inside the loop over all lights.";
    "lights-first-only" lights = Lights::First,
        "Computed the first light only.";
    "lights-last-only" lights = Lights::Last,
        "Wrote `colour =` instead of `colour +=` in the loop: only the last light is left.";
    "lights-mean" lights = Lights::Mean,
        "Divided the sum over lights by their count, so that nothing gets too bright.";

    // --- The ambient term ------------------------------------------------------------------

    "ambient-missing" ambient = Ambient::Missing,
        "Left out the ambient term.";
    // https://github.com/calder-gl/calder/pull/59
    "ambient-per-light" ambient = Ambient::PerLight,
        "Added the ambient term inside the loop: once per light.";
    // https://github.com/alecjacobson/computer-graphics-ray-tracing/issues/1
    "ambient-without-ka" ambient = Ambient::WithoutKa,
        "Added the ambient intensity without multiplying it by ka.";
    "ambient-without-ia" ambient = Ambient::WithoutIa,
        "Added ka without multiplying it by the ambient intensity.";
    "ambient-times-kd" ambient = Ambient::TimesKd,
        "Multiplied the ambient intensity by the diffuse colour kd instead of ka.";
    // https://github.com/sinisterchipmunk/jax/issues/35
    "ambient-attenuated" ambient = Ambient::Attenuated,
        "Added the ambient term to each light's terms, and attenuated it with them.";

    // --- The diffuse term ------------------------------------------------------------------

    // L21 2.1 prints L·N without a maximum.
    "diffuse-not-clamped" diffuse_cosine = DiffuseCosine::NotClamped,
        "Forgot the maximum with 0 around dot(n, l): light from behind is subtracted.";
    "diffuse-absolute" diffuse_cosine = DiffuseCosine::Absolute,
        "Wrote abs(dot(n, l)): the dark side is lit too.";
    "diffuse-half" diffuse_cosine = DiffuseCosine::Half,
        "Used half Lambert, dot(n, l) * 0.5 + 0.5, from a tutorial for games.";
    "diffuse-n-dot-v" diffuse_cosine = DiffuseCosine::NormalView,
        "Used the view vector instead of the light vector in the diffuse term: dot(n, v).";
    "diffuse-wrapped" diffuse_cosine = DiffuseCosine::Wrapped,
        "Wrapped the light around: max(0, (dot(n, l) + 0.5) / 1.5).";
    "diffuse-squared" diffuse_cosine = DiffuseCosine::Squared,
        "Squared dot(n, l).";
    "diffuse-of-angle" diffuse_cosine = DiffuseCosine::OfAngle,
        "Let the diffuse term fall with the angle: 1 - acos(dot(n, l)) / (pi / 2).";
    "diffuse-in-steps" diffuse_cosine = DiffuseCosine::FourSteps,
        "Cut dot(n, l) down to quarters for a cartoon: floor(4 * dot(n, l)) / 4.";
    "diffuse-missing" diffuse_term = DiffuseTerm::Missing,
        "Left out the diffuse term.";
    "diffuse-over-pi" diffuse_term = DiffuseTerm::OverPi,
        "Divided the diffuse term by pi, as physically based renderers do.";

    "diffuse-without-shine" diffuse_term = DiffuseTerm::WithoutShine,
        "Multiplied kd by 1 - ks, so that a surface does not reflect more light than it gets.";

    // --- The sum of the terms --------------------------------------------------------------

    "terms-mixed" terms = Terms::Mixed,
        "Mixed where one adds: mix(diffuse, light * ks, pow(dot(r, v), n)).";
    "terms-mixed-with-light" terms = Terms::MixedWithLight,
        "Mixed where one adds, with the light's colour: mix(diffuse, light, ks * pow(dot(r, v), n)).";
    "terms-ambient-as-least" terms = Terms::AmbientIsLeast,
        "Took the ambient term as a lower limit: max(ambient, diffuse + specular).";
    "terms-larger" terms = Terms::LargerOfTwo,
        "Took the larger of the diffuse and the specular term of a light, not their sum.";

    // --- The specular term -----------------------------------------------------------------

    // https://www.videogamerlife.com/phong-shading-lacking-specular-lighting-skipped-face
    "specular-missing" specular_term = SpecularTerm::Missing,
        "Left out the specular term.";
    // https://github.com/godotengine/godot/issues/50455
    "specular-energy" specular_term = SpecularTerm::EnergyConserving,
        "Multiplied the specular term by (n + 8) / (8 pi), which the scene's ks does not expect.";
    "specular-energy-of-lobe" specular_term = SpecularTerm::EnergyConservingLobe,
        "Multiplied the specular term by (n + 2) / (2 pi), which the scene's ks does not expect.";
    "specular-hue-of-kd" specular_colour = SpecularColour::HueOfKd,
        "Tinted the specular term as metals do: times kd divided by its largest channel.";
    "specular-fresnel" fresnel = Fresnel::OneMinusCosine,
        "Multiplied the specular term by 1 - dot(n, v).";
    // https://github.com/ggambetta/computer-graphics-from-scratch/issues/17
    "specular-times-kd" specular_colour = SpecularColour::LightTimesKd,
        "Multiplied the specular term by the diffuse colour kd instead of ks.";
    "specular-without-light-colour" specular_colour = SpecularColour::KsAlone,
        "Left the light's colour out of the specular term: highlights have only the colour ks.";
    "highlight-n-dot-v" highlight_cosine = HighlightCosine::NormalView,
        "Raised dot(n, v) to the exponent instead of dot(r, v).";
    "highlight-n-dot-l" highlight_cosine = HighlightCosine::NormalLight,
        "Raised dot(n, l) to the exponent instead of dot(r, v).";
    // https://github.com/kateusz/GameEngine/pull/430
    // https://github.com/vispy/vispy/pull/2091
    "highlight-other-model" highlight_cosine = HighlightCosine::OtherModel,
        "Used dot(n, h) where the scene asks for dot(r, v), or the reverse, with the same exponent.";
    // https://github.com/KhronosGroup/glTF-Sample-Viewer/issues/77
    "reflection-negated" reflection = Reflection::Negated,
        "Reflected l itself, with reflect(l, n) instead of reflect(-l, n): r points into the surface.";
    "reflection-without-two" reflection = Reflection::WithoutTwo,
        "Forgot the 2 in r = 2 (n . l) n - l.";
    // https://github.com/community-shaders/skyrim-community-shaders/pull/1517
    "reflection-of-view" reflection = Reflection::OfView,
        "Used the wrong cosine in the reflection: r = 2 (n . v) n - l.";
    // https://stackoverflow.com/questions/24132774
    "reflection-bracketed" reflection = Reflection::BracketedDifference,
        "Put the bracket in the wrong place: r = 2 (n . l) (n - l).";
    "reflection-bracketed-unit" reflection = Reflection::UnitBracketedDifference,
        "Put the bracket in the wrong place, and normalised: r = normalize(2 (n . l) (n - l)).";
    // https://github.com/gfxfundamentals/webgl-fundamentals/issues/78
    "half-vector-not-unit" half_vector = HalfVector::NotNormalised,
        "Did not normalise the half vector: h = l + v.";
    "half-vector-mean" half_vector = HalfVector::Mean,
        "Took the half vector literally: h = (l + v) / 2.";
    // https://github.com/glslify/glsl-ggx/issues/1
    "half-vector-difference" half_vector = HalfVector::Difference,
        "Subtracted instead of adding for the half vector: h = normalize(l - v).";
    "half-vector-of-distances" half_vector = HalfVector::OfDistances,
        "Added the vectors toward light and eye before they were normalised: h = normalize((light - p) + (eye - p)).";
    // https://community.khronos.org/t/71420
    "half-vector-constant" half_vector = HalfVector::Constant,
        "Computed h once for each light: normalize(normalize(light) + normalize(eye)).";
    // https://github.com/processing/processing/issues/5362
    // https://github.com/glslify/glsl-specular-phong/issues/3
    "gate-missing" gate = Gate::Missing,
        "Computed the highlight even where the light is behind the surface.";
    "highlight-times-diffuse" gate = Gate::TimesDiffuse,
        "Multiplied the highlight by dot(n, l) too: (kd + ks * spec) * ndotl.";
    // CS171 2: the maximum stands inside the power.
    "specular-not-clamped" specular_clamp = SpecularClamp::NotClamped,
        "Forgot the maximum with 0 before the power: pow(dot(r, v), n) is bright again where r points away from the eye.";

    // --- The exponent ----------------------------------------------------------------------

    "exponent-missing" exponent = Exponent::Missing,
        "Forgot the exponent: the highlight is dot(r, v) itself.";
    // https://github.com/MicrosoftDocs/win32/pull/178
    "exponent-as-factor" exponent = Exponent::Factor,
        "Multiplied by the shininess, which is an exponent.";
    "exponent-128" exponent = Exponent::Times128,
        "Multiplied the shininess by 128, as for materials whose shininess is from 0 to 1.";
    "exponent-of-product" exponent = Exponent::OfProduct,
        "Closed the bracket too late: pow(ks * dot(r, v), n).";
    "exponent-not-converted" exponent = Exponent::NotConverted,
        "Used the exponent that is meant for dot(r, v) with dot(n, h), unconverted.";
    "exponent-divided" exponent = Exponent::DividedByFour,
        "Converted the exponent in the wrong direction: a fourth for dot(n, h) instead of four times as much.";

    // --- The view vector -------------------------------------------------------------------

    // https://github.com/vispy/vispy/pull/2091
    "view-negated" view = View::Negated,
        "Took the view vector from the eye to the surface: v = p - eye.";
    // https://github.com/galacean/engine/issues/636
    "view-along-z" view = View::AlongZ,
        "Took v = (0, 0, 1) in world space, as if the camera looked along -z.";
    "view-at-eye" view = View::AlwaysAtEye,
        "Computed v = normalize(eye - p) at each point where the scene's viewer is at infinity.";
    // L21 1 assumes that the eye is at infinity.
    "view-far-away" view = View::AlwaysFarAway,
        "Used one v for all points where the scene's viewer is at the camera.";
    // https://github.com/mrdoob/three.js/pull/481
    "view-toward-origin" view = View::TowardOrigin,
        "Took v = normalize(-p), which is right in the camera's space, with p in world space.";
    "view-of-two-spaces" view = View::OfTwoSpaces,
        "Subtracted the point in the camera's space from the eye in world space: v = normalize(eye - p).";
    "view-of-unit-vectors" view = View::DifferenceOfUnits,
        "Normalised too early: v = normalize(normalize(eye) - normalize(p)).";
    "view-at-vertices" view = View::AtVertices,
        "Normalised the vector toward the eye at vertices, interpolated it, and normalised it again.";
    // https://github.com/openframeworks/openFrameworks/issues/6221
    // https://github.com/CesiumGS/cesium/issues/11994
    "view-not-unit" view_length = ViewLength::NotNormalised,
        "Forgot to normalise the vector toward the eye: v = eye - p.";

    // --- Falloff ---------------------------------------------------------------------------

    "falloff-missing" falloff = Falloff::Missing,
        "Left out the attenuation of positional lights.";
    // https://github.com/google/filament/issues/5183
    "falloff-not-squared" falloff = Falloff::NotSquared,
        "Attenuated by the distance, not by its square: 1 / (1 + k d).";
    // https://github.com/urho3d/urho3d/issues/2347
    "falloff-multiplied" falloff = Falloff::Multiplied,
        "Multiplied by 1 + k d^2 where one divides by it.";
    "falloff-inverse-square" falloff = Falloff::InverseSquare,
        "Used 1 / d^2 whatever attenuation the scene asks for.";
    "falloff-diffuse-only" falloff = Falloff::DiffuseOnly,
        "Attenuated the diffuse term only.";

    // --- Rate of shading and interpolation -------------------------------------------------

    // https://github.com/PacktPublishing/Unity-2021-Shaders-and-Effects-Cookbook-Fourth-Edition/issues/1
    "gouraud" rate = Rate::Vertex,
        "Computed light at vertices and interpolated colours: Gouraud shading instead of Phong shading.";
    "flat" rate = Rate::Face,
        "Computed light once per polygon, with the polygon's normal.";
    "flat-first-vertex" rate = Rate::FirstVertex,
        "Computed light once per polygon, at its first vertex, as `flat` varyings do.";
    // CS171 3, Algorithm 6.
    "flat-mean-normal" rate = Rate::MeanNormal,
        "Computed light once per triangle, with the mean of its three vertex normals.";
    // https://github.com/capnramses/antons_opengl_tutorials_book/issues/19
    // https://github.com/pygfx/pygfx/pull/570
    // https://how-to-3d.twodee.org/lighting/interpolating-normals.html
    "normal-not-normalised" pixel_normal = PixelNormal::AsInterpolated,
        "Did not normalise the interpolated normal at each pixel.";
    // https://github.com/ema2159/tinyrenderer_rs
    "normal-not-normalised-but-reflection" pixel_normal = PixelNormal::ReflectionAlone,
        "Did not normalise the interpolated normal at each pixel, but the reflected ray.";
    // L21 4.3 divides by |N|^2 where 4.2 divides by |N|.
    "normal-not-normalised-in-highlights" pixel_normal = PixelNormal::NotInHighlights,
        "Normalised the interpolated normal for the diffuse term, and forgot it for the specular term.";
    "normal-root-in-highlights" pixel_normal = PixelNormal::RootInHighlights,
        "Divided by |N| in the specular term of fast Phong shading, whose denominator is |N|^2.";
    // https://github.com/yfeng95/DECA/issues/198
    "weights-rotated" weights = Weights::Rotated,
        "Assigned the barycentric weights to the wrong corners: the area opposite a counted for b, and so on.";
    // https://github.com/zesterer/euc/issues/5
    "interpolation-on-screen" interpolation = Interpolation::OnScreen,
        "Interpolated linearly on the screen where the scene asks for perspective-correct interpolation.";
    // https://github.com/trenki2/SoftwareRenderer/issues/1
    "interpolation-times-w" interpolation = Interpolation::TimesW,
        "Multiplied by w where perspective-correct interpolation divides by it.";

    // --- Normals ---------------------------------------------------------------------------

    // https://github.com/vispy/vispy/pull/2091 (faceforward)
    "normal-faces-viewer" normal_sign = NormalSign::TowardViewer,
        "Turned every normal toward the viewer: if dot(n, v) < 0 then n = -n, at each pixel.";
    // https://github.com/danielepanozzo/cg-old/issues/6
    // https://github.com/tinyobjloader/tinyobjloader/issues/330
    "normals-reversed" polygon_normal = PolygonNormal::Reversed,
        "Swapped the factors of the cross product: computed normals point inward.";
    // L21 1.1: Newell's formula is there because this fails.
    "normals-of-first-corner" polygon_normal = PolygonNormal::FirstCorner,
        "Took a polygon's normal from its first two edges, not by Newell's formula: reversed where that corner is concave.";
    // https://github.com/mrdoob/three.js/issues/5059
    // https://github.com/alecjacobson/computer-graphics-meshes/issues/8
    "normals-area-weighted" vertex_normal = VertexNormal::AreaWeighted,
        "Averaged polygon normals without normalising them first: large polygons count for more.";
    // https://github.com/bevyengine/bevy/issues/18383
    // https://github.com/CGAL/cgal/issues/2047
    "normals-angle-weighted" vertex_normal = VertexNormal::AngleWeighted,
        "Weighted polygon normals by their angles at the vertex, which the lecture's average does not.";
    "normals-last-polygon" vertex_normal = VertexNormal::LastPolygon,
        "Wrote `normal[v] =` instead of `normal[v] +=`: each vertex has the normal of its last polygon.";
    // https://github.com/mikedh/trimesh/issues/506
    "normals-each-triangle" vertex_normal = VertexNormal::EachTriangle,
        "Cut polygons into triangles first, and averaged the triangles' normals: a corner on a diagonal counts twice.";
    "normals-sum-kept" vertex_normal = VertexNormal::SumKept,
        "Added polygon normals up and did not normalise the sum: vertices of many polygons count for more between vertices.";
    "given-normals-ignored" normal_source = NormalSource::AlwaysAveraged,
        "Averaged normals where the scene asks for the mesh's own.";
    "given-normals-used" normal_source = NormalSource::AlwaysGiven,
        "Used the mesh's own normals where the scene asks for averaged ones.";
    "crease-ignored" normal_source = NormalSource::WithoutCrease,
        "Ignored the crease angle: sharp edges are smoothed over.";
    "normals-are-positions" normal_source = NormalSource::Positions,
        "Used a vertex's position in model space as its normal, which is right for a sphere.";
    // OBJ files count from 1.
    "normals-of-vertex-before" normal_index = NormalIndex::Before,
        "Looked normals up one index too low; the first one is the last of the list.";
    "normals-of-vertex-after" normal_index = NormalIndex::After,
        "Looked normals up one index too high; the last one is the first of the list.";
    "normals-x-negated" normal_axes = NormalAxes::XNegated,
        "Negated x of the mesh's normals.";
    "normals-y-negated" normal_axes = NormalAxes::YNegated,
        "Negated y of the mesh's normals.";
    "normals-z-negated" normal_axes = NormalAxes::ZNegated,
        "Negated z of the mesh's normals.";
    "normals-xy-exchanged" normal_axes = NormalAxes::XyExchanged,
        "Exchanged x and y of the mesh's normals.";
    "normals-xz-exchanged" normal_axes = NormalAxes::XzExchanged,
        "Exchanged x and z of the mesh's normals.";
    "normals-yz-exchanged" normal_axes = NormalAxes::YzExchanged,
        "Exchanged y and z of the mesh's normals.";
    "normals-halved" normal_code = NormalCode::Halved,
        "Stored normals as colours, (n + 1) / 2, and did not decode them.";
    // https://github.com/bevyengine/bevy/issues/2955
    // https://github.com/KhronosGroup/glTF-Sample-Viewer/issues/60
    // https://github.com/bdero/flutter_scene/issues/140
    "normals-by-matrix" normal_transform = NormalTransform::Matrix,
        "Transformed normals by the model matrix, not by its inverse transpose.";
    // https://github.com/PacktPublishing/3D-Graphics-Rendering-Cookbook/issues/15
    "normals-by-inverse" normal_transform = NormalTransform::Inverse,
        "Transformed normals by the inverse of the model matrix, and forgot to transpose it.";
    // https://github.com/MathNuts/SkeletalAnimation/issues/1
    "normals-not-transformed" normal_transform = NormalTransform::Missing,
        "Left normals in model space.";
    // https://github.com/magcius/noclip.website/pull/203
    "normals-as-points" normal_transform = NormalTransform::AsPoint,
        "Transformed normals with w = 1, as points: the translation is added to them.";
    // https://github.com/oframe/ogl/issues/105
    "normals-in-eye-space" normal_space = NormalSpace::Eye,
        "Transformed normals to the camera's space, and left lights and view vector in world space.";

    // https://github.com/ssloy/tinyrenderer
    "normals-with-w-of-target" normal_w = NormalW::OfTarget,
        "Moved normals by the inverse transpose of a view matrix about the target, and normalised all four components: w = dot(n, target).";
    "normals-with-w-of-eye" normal_w = NormalW::OfEye,
        "Moved normals by the inverse transpose of the view matrix, and normalised all four components: w = dot(n, eye).";

    // https://github.com/rustgd/cgmath/issues/448
    "model-matrix-transposed" model_matrix = ModelMatrix::Transposed,
        "Stored the model matrix by rows and read it by columns: objects turn the other way.";
    "model-matrix-missing" model_matrix = ModelMatrix::Missing,
        "Drew objects in model space, where they all stand in the middle.";

    // --- The camera ------------------------------------------------------------------------

    // https://github.com/nvpro-samples/gl_ssao/issues/2
    "fov-in-degrees" field_of_view = FieldOfView::Degrees,
        "Passed degrees to tan.";
    "fov-not-halved" field_of_view = FieldOfView::NotHalved,
        "Forgot to halve the field of view: tan(fovy) instead of tan(fovy / 2).";
    // https://github.com/openblack/openblack/pull/788
    "fov-horizontal" field_of_view = FieldOfView::Horizontal,
        "Used the vertical field of view as the horizontal one.";
    "half-height-as-height" half_height = HalfHeight::TakenAsHeight,
        "Used half_height as the whole height that an orthographic camera sees.";
    // https://github.com/lsalzman/tesseract/issues/24 (also width / height with integers)
    "aspect-missing" aspect = Aspect::Missing,
        "Left out the aspect ratio: the picture is stretched to its width.";
    // https://github.com/HandmadeMath/HandmadeMath/issues/100
    "aspect-inverted" aspect = Aspect::Inverted,
        "Swapped width and height in the aspect ratio.";
    // https://github.com/NJU-3DV/Relightable3DGaussian/issues/23
    "aspect-on-height" aspect = Aspect::OnHeight,
        "Divided the height by the aspect ratio instead of the width.";
    // https://github.com/recp/cglm/pull/243
    // https://github.com/cisc3620/review/issues/11
    "camera-left-handed" camera_right = CameraRight::UpTimesForward,
        "Swapped the factors of right = forward x up: the picture is mirrored, and culling leaves the insides.";
    "camera-up-as-given" camera_up = CameraUp::AsGiven,
        "Used the scene's up vector as the camera's y axis, without making it perpendicular to the line of sight.";
    // https://github.com/Derydoca/derydocaengine/issues/1
    "view-matrix-transposed" view_matrix = ViewMatrix::Transposed,
        "Used the camera's axes as columns of the view matrix where they are rows: the rotation is not inverted.";
    // https://github.com/dotnet/runtime/issues/34859
    "view-matrix-translated-last" view_matrix = ViewMatrix::TranslatedLast,
        "Rotated first and then subtracted the eye: R p - eye instead of R (p - eye).";
    "division-missing" division = Division::Missing,
        "Forgot to divide by w.";
    // https://github.com/ssloy/tinyrenderer/issues/94
    // https://github.com/ocornut/imgui/issues/1047
    "upside-down" viewport = Viewport::UpsideDown,
        "Let y grow upward in the picture, whose first row is the upper one.";
    "viewport-less-one" viewport = Viewport::LessOnePixel,
        "Mapped -1..1 to 0..width - 1 and 0..height - 1.";

    // --- Filling polygons ------------------------------------------------------------------

    // https://github.com/nesbox/TIC-80/issues/776
    "half-pixel" sample_point = SamplePoint::Corner,
        "Tested (x, y) instead of (x + 0.5, y + 0.5): the picture is half a pixel off.";
    // https://github.com/gonetz/GLideN64/issues/1731
    "corners-on-whole-pixels" screen_corners = ScreenCorners::WholePixels,
        "Rounded the corners of polygons to whole pixels.";
    "corners-on-whole-pixels-tested-there" screen_corners = ScreenCorners::WholePixelsTestedThere,
        "Rounded the corners of polygons to whole pixels, and tested (x, y) of each pixel.";
    "corners-cut" screen_corners = ScreenCorners::CutDown,
        "Stored the corners of polygons as integers: (int) x.";
    "corners-cut-tested-there" screen_corners = ScreenCorners::CutDownTestedThere,
        "Stored the corners of polygons as integers, and tested (x, y) of each pixel.";
    // https://github.com/dolphin-emu/dolphin/pull/9350
    "culling-reversed" culling = Culling::Reversed,
        "Left out the front faces: the sign of the area was wrong.";
    "culling-missing" culling = Culling::Missing,
        "Left out back-face culling.";
    // https://github.com/google/filament/issues/3638
    "mirrored-winding" mirrored_winding = MirroredWinding::Forgotten,
        "Forgot about negative scales: mirrored objects are seen from inside.";
    "depth-reversed" depth = Depth::Farthest,
        "Wrote > instead of < in the depth test: the farthest polygon is seen.";
    // https://github.com/h0MER247/swGL/issues/4
    "depth-missing" depth = Depth::Missing,
        "Drew without a depth test: the last polygon is seen.";
    // https://github.com/ssloy/tinyrenderer/issues/95
    "depth-starts-at-zero" depth = Depth::StartsAtZero,
        "Filled the depth buffer with 0 where depth goes from -1 to 1: the farther half is missing.";
    "depth-of-triangle" depth = Depth::OfTriangle,
        "Used one depth per triangle, the mean of its corners.";
    "depth-ties-to-last" depth = Depth::TiesToLast,
        "Wrote <= instead of < in the depth test: of equally near polygons the last is seen.";
    // https://github.com/kaisalmen/WWOBJLoader/pull/74
    "triangles-fan" triangles = Triangles::FanAlways,
        "Cut concave polygons into a fan about their first corner.";
    // https://github.com/tinyobjloader/tinyobjloader/issues/295
    "triangles-first-three" triangles = Triangles::FirstThree,
        "Read the first three corners of each polygon only.";
    "triangles-strip" triangles = Triangles::Strip,
        "Cut quads into (0, 1, 2) and (1, 2, 3), as a strip, not (0, 2, 3).";
    // https://github.com/Marzac/le3d/issues/38
    "box-exclusive" box_end = BoxEnd::Exclusive,
        "Ended the loops over a triangle's bounding box one pixel too early: there are cracks.";

    // --- The picture -----------------------------------------------------------------------

    // https://blog.molecular-matters.com/2011/11/21/gamma-correct-rendering/
    "encoding-linear" encoding = Encoding::Linear,
        "Stored linear values where the scene asks for sRGB: too dark.";
    "encoding-srgb" encoding = Encoding::Srgb,
        "Applied the sRGB curve where the scene asks for linear values: too bright.";
    "encoding-gamma-2.2" encoding = Encoding::Gamma22,
        "Applied pow(c, 1 / 2.2), whatever the scene asks for.";
    // https://medium.com/@Jacob_Bell/programmers-guide-to-gamma-correction-4c1d3a1724fb
    "encoding-twice" encoding = Encoding::SrgbTwice,
        "Applied the sRGB curve twice.";
    "encoding-decoded" encoding = Encoding::Decoded,
        "Applied gamma in the wrong direction: pow(c, 2.2).";
    // https://github.com/web-platform-tests/wpt/issues/62525
    "rounding-down" rounding = Rounding::Down,
        "Cut the fraction off: (int) (255 * c).";
    // https://github.com/RayTracing/TheRestOfYourLife/pull/5
    "rounding-256" rounding = Rounding::Times256,
        "Multiplied by 256: white becomes 256, which is 0 in a byte.";
    // https://github.com/kidoman/rays/issues/17
    // https://github.com/RayTracing/TheNextWeek/issues/8
    "overflow-wraps" overflow = Overflow::Wraps,
        "Did not clamp colours before storing them in bytes: colours brighter than white turn dark again.";
    "overflow-normalised" overflow = Overflow::DividedByBrightest,
        "Divided the picture by its brightest value.";
    // https://github.com/RayTracing/TheNextWeek/issues/7
    "overflow-by-largest-channel" overflow = Overflow::DividedByOwnLargest,
        "Divided colours that are too bright by their largest channel, not clamping each channel.";
    "overflow-tone-mapped" overflow = Overflow::ToneMapped,
        "Tone-mapped the picture: c / (1 + c).";
    // https://github.com/milgra/kuid/issues/1
    // https://github.com/danginsburg/opengles3-book/pull/45
    "channels-bgr" channels = Channels::Bgr,
        "Wrote blue, green, red.";
    "channels-grey" channels = Channels::Grey,
        "Wrote the mean of the channels to all three of them.";
    "channels-grb" channels = Channels::Grb,
        "Wrote green, red, blue.";
    "channels-rbg" channels = Channels::Rbg,
        "Wrote red, blue, green.";
    "background-black" background = Background::Black,
        "Left the background black.";
    "background-white" background = Background::White,
        "Left the background white.";
    // https://github.com/ingowald/pbrt-parser/pull/33
    "layout-right-to-left" layout = Layout::RightToLeft,
        "Mirrored the picture: x counts from the right.";
    "layout-half-turn" layout = Layout::HalfTurn,
        "Wrote the pixels from the last to the first: the picture is turned by 180 degrees.";
    "layout-columns" layout = Layout::Columns,
        "Stored pixels at x * height + y and read them as rows.";
    "layout-one-row-down" layout = Layout::OneRowDown,
        "Flipped y as height - y instead of height - 1 - y: the picture is one row too low.";
    "layout-one-right-and-up" layout = Layout::OneRightAndUp,
        "Counted columns and rows from 1 with y upward: the picture is one pixel too far to the right and up.";
    "layout-one-left-and-down" layout = Layout::OneLeftAndDown,
        "Wrote pixels one too far to the left and down.";
}
