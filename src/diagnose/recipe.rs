//! A recipe: how a picture of a scene is drawn, right or with mistakes. The default recipe draws the
//! scene as it is stated; a mistake sets some of the choices (`mistakes.rs`).
//!
//! Choices stand in four parts, in the order in which a picture is made: [`Geometry`] (which polygon
//! is seen at a pixel, and where in it), [`Place`] (which pixel of that picture is taken), [`Shading`]
//! (its light), [`Storage`] (the levels in the file). What is computed for one part is kept for all
//! recipes that agree in it.

use crate::picture::Encoding;
use crate::scene::{Culling, HiddenSurfaces, Projection, Scene, SpecularGate};

/// All choices of a picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Recipe {
    pub geometry: Geometry,
    pub place: Place,
    pub shading: Shading,
    pub storage: Storage,
}

impl Recipe {
    /// Returns the recipe in which choices say nothing that say what `scene` states.
    pub fn of_scene(mut self, scene: &Scene) -> Recipe {
        let is_square = scene.width == scene.height;
        // Columns of a square picture, read as rows, exchange x and y.
        let is_other = if is_square {
            Place::Columns
        } else {
            Place::Transposed
        };
        if self.place == is_other {
            self.place = Place::Stated;
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

/// The choices that decide which polygon is seen at a pixel, and with which weights of its vertices.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Geometry {
    pub cut: Cut,
    /// The sides that are left out; `None`: those of the scene.
    pub culling: Option<Culling>,
    pub depth: Depth,
    pub interpolation: Interpolated,
    pub weights: Corners,
    pub lens: Lens,
    pub aspect: Aspect,
    pub near: Near,
    /// Halves of a pixel by which everything is moved to the right and downward.
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
    /// From 0 to width − 1 and height − 1.
    LessOne,
}

/// The winding of objects that a mirroring transform turns around.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Mirrored {
    #[default]
    Outside,
    /// The inside of mirrored objects is seen.
    Inside,
}

/// The triangles that polygons of more than three sides are cut into.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Cut {
    /// None: interpolation along edges and spans, as the lecture has it.
    #[default]
    Whole,
    /// A fan around the first corner; concave polygons by ear clipping.
    Fan,
    /// The same around the second corner: the other diagonal of a quadrilateral.
    OtherFan,
    /// A fan, of quadrilaterals along the shorter diagonal.
    Shorter,
    /// A fan around the first corner, of concave polygons too; sides are left out triangle by triangle.
    FanOfConcave,
    /// A fan without its last triangle.
    FanWithoutLast,
    /// The first triangle of the fan alone.
    FirstTriangle,
    /// Corners 0 1 2, 1 2 3 and so on.
    Strip,
}

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
    /// Linear on the screen for perspective, and the reverse.
    Other,
    /// Multiplied by w where perspective divides by it.
    TimesW,
}

/// The corners of triangles that barycentric coordinates are given to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Corners {
    #[default]
    Own,
    /// Each corner has the weight of the next.
    Next,
    /// Each corner has the weight of the one before.
    Before,
}

/// The search for the nearest polygon.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Depth {
    /// As the scene states it.
    #[default]
    Stated,
    /// The farthest polygon is seen.
    Reversed,
    /// The last polygon of the file is seen.
    LastInFile,
    /// The first polygon of the file is seen.
    FirstInFile,
    /// Polygons have one depth each, the mean of their corners.
    OfPolygons,
    /// The last of equally near polygons is seen.
    TiesToLast,
}

/// The field of view.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Lens {
    #[default]
    Stated,
    /// tan(fovy/2) of an angle in degrees, taken for radians.
    Degrees,
    /// tan(fovy) of an angle in degrees, taken for radians.
    WholeDegrees,
    /// tan(fovy/4), or half of the height.
    Half,
    /// tan(fovy), or twice the height.
    Double,
    /// The vertical angle, taken for the horizontal one.
    Horizontal,
    /// Orthographic for perspective, of the same size at the target, and the reverse.
    OtherProjection,
}

/// The ratio of width and height.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Aspect {
    #[default]
    Stated,
    /// Left out: a square view fills the picture.
    Missing,
    /// x is multiplied by it.
    Inverted,
    /// y is divided by it, and not x.
    OnHeight,
}

/// The treatment of polygons that reach in front of the near plane.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Near {
    /// They are cut there.
    #[default]
    Cut,
    /// They are left out.
    LeftOut,
    /// They are not cut: corners behind the eye are divided by w like others.
    Divided,
}

/// The place in the picture of a scene that a pixel of the file shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Place {
    #[default]
    Stated,
    MirroredX,
    MirroredY,
    Turned,
    /// Moved by so many pixels to the right and downward.
    Moved([i8; 2]),
    /// Columns are stored one after another, and read as rows.
    Columns,
    /// x and y are exchanged, of a picture as wide as high.
    Transposed,
}

/// The choices that decide the light at a point of a polygon.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Shading {
    pub rate: Rate,
    pub normals: Normals,
    pub normal_sign: Sign,
    pub normal_length: Length,
    pub normal_space: Space,
    /// The same of the normal in highlights only.
    pub highlight_normal: Length,
    pub facing: Facing,
    pub light_sign: Sign,
    pub light_axes: Axes,
    pub light_space: Space,
    pub light_place: LightPlace,
    pub light_length: Length,
    pub falloff: FalloffUse,
    pub lights: LightUse,
    pub light_colour: LightColour,
    pub viewer: Viewer,
    pub view_sign: Sign,
    pub view_length: Length,
    pub cosine: Cosine,
    pub reflected: Reflected,
    pub highlight: Highlight,
    pub halfway: Halfway,
    pub cap: Cap,
    pub exponent: Exponent,
    /// `None`: as the scene states it.
    pub gate: Option<SpecularGate>,
    pub ambient: AmbientUse,
    pub diffuse: DiffuseUse,
    pub specular: SpecularUse,
    pub sum: Sum,
    pub materials: MaterialUse,
}

/// The material of a polygon.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum MaterialUse {
    #[default]
    Own,
    /// The first one for all.
    First,
    /// The default one, as if no material had been read.
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
    /// At each vertex, and colours over 1 are clamped only at pixels.
    VertexUnclamped,
    /// Once a polygon, with its own normal (L21 2).
    Face,
    /// Once a polygon, with the mean of its vertex normals.
    FaceMean,
    /// Once a polygon, with the normal of its first vertex, at that vertex.
    FirstVertex,
    /// At each pixel, with L and V of the middle of the polygon.
    ConstantVectors,
    /// By the method of this place in `METHODS`, drawn by its engine.
    Method(u8),
}

/// The vertex normals.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Normals {
    #[default]
    Stated,
    /// The polygon's own normal at each of its corners.
    OfFaces,
    /// The same, as long as twice the area of the polygon.
    OfFacesRaw,
    /// Averages weighted by the areas of polygons: Newell's sums, not normalised.
    ByArea,
    /// Averages weighted by the angles of polygons at the vertex.
    ByAngle,
    /// Averages over polygons that share a vertex of the file: others at its position do not count.
    ByIndex,
    /// Averages over all polygons at a position, whatever the file or a crease says.
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
    /// Those of the file, where the scene has averages.
    OfFile,
    /// That of the last polygon at each vertex.
    OfLastPolygon,
    /// Averages of normals from the first two edges of polygons.
    OfFirstEdges,
    /// Averages over the triangles that polygons are cut into.
    OfTriangles,
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
    /// As it comes.
    Raw,
}

/// The treatment of normals that look away from the viewer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Facing {
    #[default]
    Stated,
    /// Turned toward the viewer, pixel by pixel.
    TowardViewer,
    /// Left as they are where the scene is two-sided.
    OneSided,
}

/// The axes of light directions and positions.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Axes {
    #[default]
    Stated,
    NegatedX,
    NegatedY,
    NegatedZ,
    /// y and z exchanged.
    ZUp,
}

/// The space in which lights are stated.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Space {
    #[default]
    World,
    /// That of the camera: x to the right, y up, z toward the viewer.
    Camera,
}

/// The reading of a light's three numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum LightPlace {
    #[default]
    Stated,
    /// Positions are directions.
    PositionsAreDirections,
    /// Directions are positions.
    DirectionsArePositions,
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
    /// All, and their sum is divided by their number.
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
    /// That of the first light for all.
    OfFirst,
    /// Left out of highlights.
    WhiteHighlights,
}

/// The place of the viewer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Viewer {
    #[default]
    Stated,
    /// Infinitely far away for at the eye, and the reverse.
    Other,
    /// The position of the eye, taken for the direction to it.
    EyeAsDirection,
    /// V = (0, 0, 1).
    AlongZ,
    /// V = −P, as if the eye were at the origin.
    AtOrigin,
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
}

/// The reflected ray.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Reflected {
    /// R = 2 (L·N) N − L.
    #[default]
    Right,
    /// −R: of the ray from the light.
    Negated,
    /// (L·N) N − L.
    WithoutTwo,
    /// 2 (L·N) N + L.
    Plus,
    /// 2 (N·V) N − L.
    OfView,
}

/// The cosine of highlights, where R·V and N·H are exchanged.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Highlight {
    #[default]
    Stated,
    /// The other one, with the same exponent.
    Other,
    /// The other one, with an exponent that makes the highlight as large.
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
}

/// The cosine of a highlight below 0.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Cap {
    /// It counts as 0.
    #[default]
    Clamped,
    /// It is raised to the exponent: positive where that is even.
    Unclamped,
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
    /// 128 times as much, as for shininess of 0 to 1.
    Times128,
    /// 1: the power is left out.
    One,
    /// It is a factor.
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
    /// Added once for each light, and weakened with it.
    WithFalloff,
}

/// The diffuse term.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum DiffuseUse {
    #[default]
    Stated,
    Missing,
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
}

/// The treatment of sums over 1.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Sum {
    /// Clamped at the end.
    #[default]
    Clamped,
    /// Each light is clamped before it is added.
    ClampedPerLight,
}

/// The choices that decide the levels in the file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Storage {
    pub curve: Curve,
    pub channels: Channels,
    pub rounding: Rounding,
    pub range: LevelRange,
}

/// The curve from linear light to what is stored.
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
    /// The mean of the three in each.
    Grey,
}

/// The way from 0..=1 to whole levels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Rounding {
    #[default]
    Nearest,
    /// ⌊255 c⌋.
    Down,
    /// ⌊256 c⌋, at most 255.
    Of256,
}

/// The treatment of colours over 1.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum LevelRange {
    #[default]
    Clamped,
    /// Levels beyond 255 begin anew at 0.
    Wrapped,
    /// All colours are divided by the largest channel of the picture, or all grow until that is 255.
    Stretched,
    /// Each colour over 1 is divided by its largest channel.
    ByLargest,
    /// c/(1 + c).
    ToneMapped,
}
