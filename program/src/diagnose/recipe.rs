//! A recipe: all choices in drawing a scene, right or with mistakes. The default recipe draws what
//! the scene states. A mistake sets some of the choices (`mistakes.rs`).
//!
//! The choices have five parts, in the order in which a picture is made: [`Geometry`] (the visible
//! polygon at a pixel, and the point in it), [`Place`] (the pixel of that picture that the file
//! shows), [`Shading`] (the directions there, and their cosines), [`Mixing`] (the colours that
//! cosines are multiplied by) and [`Storage`] (the levels in the file). The first three take time,
//! so their results are stored for all recipes that agree in them.

use fastphong::picture::Encoding;
use fastphong::scene::{Culling, HiddenSurfaces, Projection, Scene, SpecularGate};

/// All choices of a picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Recipe {
    pub geometry: Geometry,
    pub place: Place,
    pub shading: Shading,
    pub mixing: Mixing,
    pub storage: Storage,
}

impl Recipe {
    /// True if its light depends on the triangles that polygons are cut into.
    pub fn depends_on_cut(&self) -> bool {
        let is_at_pixels = matches!(self.shading.rate, Rate::Pixel | Rate::Method(_));
        !is_at_pixels || self.geometry.interpolation != Interpolated::Stated
    }

    /// Resets choices that `scene` states anyway, so that two recipes of the same picture are
    /// equal.
    pub fn of_scene(mut self, scene: &Scene) -> Recipe {
        let is_square = scene.width == scene.height;
        // Columns of a square picture, read as rows, exchange x and y: that is `Transposed`. Other
        // pictures cannot be transposed and keep their size.
        let is_other = if is_square {
            Turn::Columns
        } else {
            Turn::Transposed
        };
        if self.place.turn == is_other {
            self.place.turn = Turn::Stated;
        }
        let geometry = &mut self.geometry;
        geometry.culling = geometry.culling.filter(|culling| *culling != scene.culling);
        let is_said = match geometry.depth {
            Depth::LastInFile => scene.hidden_surfaces == HiddenSurfaces::DrawOrder,
            Depth::Reversed | Depth::TiesToLast => {
                !matches!(scene.hidden_surfaces, HiddenSurfaces::ZBuffer(_))
            }
            Depth::Stated | Depth::FirstInFile | Depth::OfPolygons => false,
        };
        if is_said {
            geometry.depth = Depth::Stated;
        }
        let is_orthographic = matches!(scene.camera.projection, Projection::Orthographic { .. });
        if is_orthographic {
            geometry.interpolation = Interpolated::Stated;
            geometry.eye = Eye::Stated;
            geometry.near = Near::Cut;
            if matches!(geometry.lens, Lens::Degrees | Lens::WholeDegrees) {
                geometry.lens = Lens::Stated;
            }
        }
        if is_square {
            geometry.aspect = Aspect::Stated;
            if geometry.lens == Lens::Horizontal {
                geometry.lens = Lens::Stated;
            }
        }
        let shading = &mut self.shading;
        shading.gate = shading.gate.filter(|gate| *gate != scene.gate);
        if !scene.two_sided && shading.facing == Facing::OneSided {
            shading.facing = Facing::Stated;
        }
        let storage = &mut self.storage;
        let is_stated = match storage.curve {
            Curve::Linear => scene.encoding == Encoding::Linear,
            Curve::Srgb => scene.encoding == Encoding::Srgb,
            _ => false,
        };
        if is_stated {
            storage.curve = Curve::Stated;
        }
        self
    }
}

/// The choices that decide which polygon is visible at a pixel, and the weights of its vertices
/// there.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Geometry {
    pub cut: Cut,
    /// The sides that are left out, or `None` for the scene's choice.
    pub culling: Option<Culling>,
    pub depth: Depth,
    pub interpolation: Interpolated,
    pub weights: Corners,
    pub eye: Eye,
    pub lens: Lens,
    pub aspect: Aspect,
    pub near: Near,
    /// How far everything moves to the right and downward, in half pixels.
    pub halves: [i8; 2],
    pub corners: Snapping,
    pub mirrored: Mirrored,
}

/// The places of corners on the picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Snapping {
    #[default]
    Fine,
    /// Rounded to whole pixels.
    WholePixels,
    /// Rounded to whole pixels, where pixels are sampled at their corners.
    WholePixelsAtCorners,
    /// Cut down to whole pixels.
    CutDown,
    /// Cut down to whole pixels, where pixels are sampled at their corners.
    CutDownAtCorners,
    /// From 0 to width − 1 and height − 1.
    LessOne,
    /// From 0 to width − 1 and height − 1, where pixels are sampled at their corners.
    LessOneAtCorners,
}

/// The visible side of objects that a transform mirrors.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Mirrored {
    #[default]
    Outside,
    /// The inside of mirrored objects is visible.
    Inside,
}

/// The triangles that polygons of more than three sides are cut into.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Cut {
    /// None: interpolation runs along edges and spans, as in the lecture.
    #[default]
    Whole,
    /// A fan around the first corner; concave polygons by ear clipping.
    Fan,
    /// A fan around the second corner, which is the other diagonal of a quadrilateral.
    OtherFan,
    /// A fan, but quadrilaterals along the shorter diagonal.
    Shorter,
    /// A fan around the first corner even of concave polygons. Each triangle is culled on its own.
    FanOfConcave,
    /// A fan without its last triangle.
    FanWithoutLast,
    /// Only the first triangle of the fan.
    FirstTriangle,
    /// Corners 0 1 2, 1 2 3 and so on.
    Strip,
}

/// The harmless ways to interpolate over polygons of more than three sides.
pub const CUTS: [Cut; 4] = [Cut::Whole, Cut::Fan, Cut::OtherFan, Cut::Shorter];

impl Cut {
    /// Returns its name in data.
    pub fn name(self) -> &'static str {
        match self {
            Cut::Whole => "polygons",
            Cut::Fan => "fan",
            Cut::OtherFan => "other-diagonal",
            Cut::Shorter => "shorter-diagonal",
            Cut::FanOfConcave => "fan-of-concave",
            Cut::FanWithoutLast => "fan-without-last",
            Cut::FirstTriangle => "first-triangle",
            Cut::Strip => "strip",
        }
    }
}

/// The interpolation over the screen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Interpolated {
    #[default]
    Stated,
    /// Linear on the screen where the scene asks for perspective, or the reverse.
    Other,
    /// Multiplied by w where perspective divides by it.
    TimesW,
}

/// The corners that barycentric coordinates are assigned to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Corners {
    #[default]
    Own,
    /// Each corner has the weight of the next.
    Next,
    /// Each corner has the weight of the previous one.
    Before,
}

/// The rule that decides which polygon is visible.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Depth {
    /// The scene's rule.
    #[default]
    Stated,
    /// The farthest polygon is visible.
    Reversed,
    /// The last polygon of the file is visible.
    LastInFile,
    /// The first polygon of the file is visible.
    FirstInFile,
    /// Each polygon has one depth, the mean of its corners.
    OfPolygons,
    /// The last of equally near polygons is visible.
    TiesToLast,
}

/// The centre of projection.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Eye {
    /// The eye.
    #[default]
    Stated,
    /// A point as far behind the eye as the target is in front of it.
    Behind,
    /// A point behind the eye at the distance 1/tan(fovy/2).
    BehindByFocalLength,
}

/// The field of view.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Lens {
    #[default]
    Stated,
    /// tan(fovy/2) with degrees used as radians.
    Degrees,
    /// tan(fovy) with degrees used as radians.
    WholeDegrees,
    /// tan(fovy/4), or half of the height.
    Half,
    /// tan(fovy), or twice the height.
    Double,
    /// The vertical angle, used as the horizontal one.
    Horizontal,
    /// Orthographic in place of perspective, or the reverse, with the same size at the target.
    OtherProjection,
}

/// The ratio of width and height.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Aspect {
    #[default]
    Stated,
    /// The ratio is left out, so that a square view fills the picture.
    Missing,
    /// x is multiplied by the ratio.
    Inverted,
    /// y is divided by the ratio, and not x.
    OnHeight,
}

/// The treatment of polygons that reach in front of the near plane.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Near {
    /// They are cut at the near plane.
    #[default]
    Cut,
    /// They are left out.
    LeftOut,
    /// They are not cut: corners behind the eye are divided by w like all others.
    Divided,
}

/// The pixel of the scene's picture that a pixel of the file shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Place {
    pub turn: Turn,
    /// How far the turned picture is moved to the right and downward, in pixels.
    pub moved: [i8; 2],
}

/// The order in which the file has the pixels of a picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Turn {
    #[default]
    Stated,
    MirroredX,
    MirroredY,
    Half,
    /// The picture is stored by columns and read by rows.
    Columns,
    /// x and y are exchanged in a square picture.
    Transposed,
}

/// The choices that decide the vectors N, L and V at a point of a polygon, and their cosines.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Shading {
    pub rate: Rate,
    pub normals: Normals,
    pub normal_sign: Sign,
    pub normal_axes: Axes,
    pub normal_w: NormalW,
    pub normal_length: Length,
    pub normal_space: Space,
    /// The length of the normal in highlights only.
    pub highlight_normal: Length,
    pub facing: Facing,
    /// The space of positions where L and V are computed from them.
    pub position_space: Space,
    pub light_sign: Sign,
    pub light_axes: Axes,
    pub light_space: LightSpace,
    pub light_place: LightPlace,
    pub light_length: Length,
    pub falloff: FalloffUse,
    pub viewer: Viewer,
    pub view_rate: ViewRate,
    pub view_sign: Sign,
    pub view_length: Length,
    pub cosine: Cosine,
    pub reflected: Reflected,
    pub highlight: Highlight,
    pub halfway: Halfway,
    pub cap: Cap,
    pub exponent: Exponent,
    /// The gate of highlights, or `None` for the scene's.
    pub gate: Option<SpecularGate>,
    pub fresnel: Fresnel,
    pub materials: MaterialUse,
}

/// The choices that decide what the cosines are multiplied by.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Mixing {
    pub lights: LightUse,
    pub light_colour: LightColour,
    pub ambient: AmbientUse,
    pub diffuse: DiffuseUse,
    pub specular: SpecularUse,
    pub sum: Sum,
}

/// The material of a polygon.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum MaterialUse {
    #[default]
    Own,
    /// The first material for all polygons.
    First,
    /// The default material, as if none had been read.
    Default,
}

/// The points at which the illumination model is computed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Rate {
    /// At each pixel, with interpolated normals (L21 4.1).
    #[default]
    Pixel,
    /// At each vertex; colours are interpolated (L21 3).
    Vertex,
    /// At each vertex, but colours over 1 are clamped only at pixels.
    VertexUnclamped,
    /// Once per polygon, with its own normal (L21 2).
    Face,
    /// Once per polygon, with the mean of its vertex normals.
    FaceMean,
    /// Once per polygon, at its first vertex with the normal there.
    FirstVertex,
    /// At each pixel, with L and V from the middle of the polygon.
    ConstantVectors,
    /// By the method at this index of `METHODS`, drawn by its engine.
    Method(u8),
}

/// The vertex normals.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Normals {
    #[default]
    Stated,
    /// The polygon's own normal at each of its corners.
    OfFaces,
    /// The polygon's own normal, as long as twice its area.
    OfFacesRaw,
    /// Averages weighted by the areas of polygons: Newell's sums, not normalised.
    ByArea,
    /// Averages weighted by the angles of polygons at the vertex.
    ByAngle,
    /// Averages over polygons that share a vertex of the file. Other vertices at its position do
    /// not count.
    ByIndex,
    /// Averages over all polygons at a position, even if the file has normals or the scene a
    /// crease.
    OverPosition,
    /// Sums of unit normals that are not normalised before they are interpolated.
    Sums,
    /// Multiplied by the matrix of positions, not its inverse transpose.
    ByMatrix,
    /// Left in model space.
    OfModel,
    /// Multiplied by the inverse, not transposed.
    ByInverse,
    /// Transformed as points: the translation is added.
    AsPoints,
    /// Negated in objects that a mirroring transform turns inside out.
    InsideOut,
    /// The file's normals where the scene asks for averages.
    OfFile,
    /// The normal of the last polygon at each vertex.
    OfLastPolygon,
    /// Averages of normals from the first two edges of polygons.
    OfFirstEdges,
    /// Averages over the triangles that polygons are cut into.
    OfTriangles,
    /// The normal of the vertex before, in the order of the file.
    OfVertexBefore,
    /// The normal of the next vertex.
    OfVertexAfter,
    /// The position, from the middle of the object.
    Positions,
    /// (N + 1)/2, as textures store normals.
    Halved,
}

/// The direction of a vector.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Sign {
    #[default]
    Right,
    Negated,
}

/// The length of a vector.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Length {
    /// 1.
    #[default]
    Unit,
    /// Not normalised.
    Raw,
}

/// The treatment of normals that look away from the viewer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Facing {
    #[default]
    Stated,
    /// They are turned toward the viewer at each pixel.
    TowardViewer,
    /// They are left unchanged where the scene is two-sided.
    OneSided,
}

/// The axes of a vector.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Axes {
    #[default]
    Stated,
    NegatedX,
    NegatedY,
    NegatedZ,
    /// y and z exchanged.
    ZUp,
    /// x and y exchanged.
    ExchangedXy,
    /// x and z exchanged.
    ExchangedXz,
}

/// The space of a vector.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Space {
    #[default]
    World,
    /// The camera's space: x to the right, y up, z toward the viewer.
    Camera,
}

/// The space of lights.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum LightSpace {
    #[default]
    World,
    /// Lights are stated in the camera's space.
    Camera,
    /// Lights are moved into the camera's space.
    Moved,
    /// Positions are turned like the camera, around the world's origin.
    Turned,
    /// Lights are stated in the camera's space, and moved back by the camera's rotation twice.
    Inverse,
}

/// A fourth component of normals, which stays when they are transformed by a matrix of four rows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum NormalW {
    #[default]
    Missing,
    /// N times the target, as a view matrix around the target leaves it.
    OfTarget,
    /// N times the eye.
    OfEye,
}

/// The meaning of a light's three coordinates.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum LightPlace {
    #[default]
    Stated,
    /// Positions are used as directions.
    PositionsAreDirections,
    /// Directions are used as positions.
    DirectionsArePositions,
    /// Directions are moved by minus the eye, as a view matrix moves points.
    DirectionsMinusEye,
    /// Directions are moved by minus the target, as a view matrix around the target moves points.
    DirectionsMinusTarget,
}

/// The falloff of lights at positions.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum FalloffUse {
    #[default]
    Stated,
    Missing,
    /// 1/(1 + k r), or 1/r where the scene states 1/r².
    Linear,
    /// Multiplied by 1 + k r².
    Multiplied,
    /// Left out of highlights.
    DiffuseOnly,
    /// 1/r².
    InverseSquare,
    /// 1/r.
    Inverse,
}

/// The lights that are used.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum LightUse {
    #[default]
    All,
    First,
    Last,
    /// None: ambient light only.
    None,
    /// The mean of all.
    Mean,
}

/// The use of light colours.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum LightColour {
    #[default]
    Stated,
    White,
    /// White, as strong as the strongest channel.
    WhiteOfStrength,
    /// The colour of the first light for all.
    OfFirst,
    /// The colour is left out of highlights.
    WhiteHighlights,
}

/// The points at which V is computed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum ViewRate {
    #[default]
    Pixel,
    /// Unit vectors at vertices, interpolated and normalised again.
    Vertex,
}

/// The place of the viewer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Viewer {
    #[default]
    Stated,
    /// Infinitely far away where the scene has it at the eye, or the reverse.
    Other,
    /// The position of the eye, used as the direction to it.
    EyeAsDirection,
    /// V = (0, 0, 1).
    AlongZ,
    /// V = −P, as if the eye were at the origin.
    AtOrigin,
    /// V = eye / |eye| − P / |P|.
    OfUnits,
    /// V = eye − P with P in the camera's space, the eye in the world's.
    OfTwoSpaces,
}

/// The use of L·N.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Cosine {
    /// max(0, L·N).
    #[default]
    Clamped,
    /// |L·N|.
    Absolute,
    /// L·N, which takes light away behind the horizon.
    Signed,
    /// (L·N + 1)/2.
    Half,
    /// max(0, (L·N + ½)/1.5).
    Wrapped,
    /// max(0, L·N)².
    Squared,
    /// 1 − angle / 90°.
    Angle,
    /// Four steps of max(0, L·N), cut off.
    StepsDown,
    /// Four steps of max(0, L·N), rounded up.
    StepsUp,
}

/// The reflected ray.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Reflected {
    /// R = 2 (L·N) N − L.
    #[default]
    Right,
    /// −R, which functions called reflect return for L.
    Negated,
    /// (L·N) N − L.
    WithoutTwo,
    /// 2 (L·N) N + L.
    Plus,
    /// 2 (N·V) N − L.
    OfView,
    /// 2 (L·N) (N − L), normalised.
    TimesCosine,
    /// 2 (L·N) N − L, normalised.
    Normalised,
}

/// The cosine of highlights.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Highlight {
    #[default]
    Stated,
    /// N·H in place of R·V, or the reverse, with the same exponent.
    Other,
    /// N·H in place of R·V, or the reverse, with an exponent that makes the highlight equally
    /// large.
    OtherConverted,
    /// N·V.
    NormalView,
    /// N·L.
    NormalLight,
}

/// The vector between L and V.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Halfway {
    #[default]
    Unit,
    /// L + V.
    Sum,
    /// (L + V)/2.
    Mean,
    /// L − V, of length 1.
    Difference,
    /// L + V normalised, but L and V as long as their distances.
    OfDistances,
    /// L + V for the direction from the origin to the eye, everywhere.
    Constant,
}

/// The treatment of a negative cosine of a highlight.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Cap {
    /// It counts as 0.
    #[default]
    Clamped,
    /// It is raised to the exponent, which makes it positive if the exponent is even.
    Unclamped,
}

/// A factor of highlights at grazing angles.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Fresnel {
    #[default]
    Missing,
    /// 1 − N·V.
    OneMinusCosine,
}

/// The exponent of highlights.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Exponent {
    #[default]
    Stated,
    Half,
    Double,
    Quarter,
    Fourfold,
    /// 128 times the exponent, as if shininess went from 0 to 1.
    Times128,
    /// 1: the power is left out.
    One,
    /// The exponent is used as a factor.
    Factor,
}

/// The ambient term.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum AmbientUse {
    #[default]
    Stated,
    Missing,
    /// Added once for each light.
    PerLight,
    /// I_a without k_a.
    WithoutMaterial,
    /// k_a without I_a.
    WithoutLight,
    /// I_a k_a k_d.
    TimesDiffuse,
    /// I_a k_d.
    DiffuseColour,
    /// Added once for each light, and weakened by the light's falloff.
    WithFalloff,
}

/// The diffuse term.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum DiffuseUse {
    #[default]
    Stated,
    Missing,
    /// k_d / π.
    OverPi,
    /// k_d (1 − k_s).
    TimesRest,
}

/// The specular term.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum SpecularUse {
    #[default]
    Stated,
    Missing,
    /// I_p k_s k_d.
    TimesDiffuse,
    /// I_p k_d.
    DiffuseColour,
    /// I_p without k_s.
    WithoutMaterial,
    /// I_p (k_s R·V)ⁿ.
    InsidePower,
    /// I_p k_s times k_d divided by its largest channel.
    Tinted,
    /// I_p k_s (n + 2)/2π.
    Normalised,
    /// I_p k_s (n + 8)/8π.
    NormalisedForHalfway,
}

/// The sum of the terms.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Sum {
    /// Clamped at the end.
    #[default]
    Clamped,
    /// Each light is clamped before it is added.
    ClampedPerLight,
    /// Highlights cover diffuse light: mix(diffuse, 1, specular).
    Mixed,
    /// The larger of ambient light and the rest.
    AmbientAsFloor,
    /// The larger of diffuse and specular light, for each light.
    LargerTerm,
}

/// The choices that decide the levels in the file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Storage {
    pub curve: Curve,
    pub channels: Channels,
    pub rounding: Rounding,
    pub range: LevelRange,
}

/// The curve from linear light to stored values.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Curve {
    #[default]
    Stated,
    Linear,
    Srgb,
    /// sRGB's curve twice.
    SrgbTwice,
    /// sRGB's curve backward.
    Decoded,
    /// c^(1/2.2).
    Power,
    /// c^2.2.
    InversePower,
}

/// The order of channels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Channels {
    #[default]
    Rgb,
    Bgr,
    /// Red and green exchanged.
    Grb,
    /// Green and blue exchanged.
    Rbg,
    /// The mean of all three in each channel.
    Grey,
    /// The mean of all three levels in each channel, cut off.
    GreyOfLevels,
}

/// The rounding from 0..=1 to whole levels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Rounding {
    #[default]
    Nearest,
    /// ⌊255 c⌋.
    Down,
    /// ⌈255 c⌉.
    Up,
    /// ⌊256 c⌋, at most 255.
    Of256,
    /// ⌊256 c⌋, where 256 becomes 0.
    Of256Wrapped,
}

/// The treatment of colours over 1.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum LevelRange {
    #[default]
    Clamped,
    /// Levels beyond 255 wrap to 0.
    Wrapped,
    /// All colours are divided by the largest channel of the picture, which then has the level 255.
    Stretched,
    /// Each colour over 1 is divided by its largest channel.
    ByLargest,
    /// c/(1 + c).
    ToneMapped,
}
