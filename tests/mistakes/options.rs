//! The ways to do each step of drawing a scene: the right one, and those of students.

macro_rules! ways {
    ($($(#[$doc:meta])* $name:ident: $right:ident $(| $wrong:ident)+;)*) => {$(
        $(#[$doc])*
        ///
        /// The first way is the right one.
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
        pub enum $name {
            #[default]
            $right,
            $($wrong,)+
        }
    )*};
}

ways! {
    /// The vector L at a point.
    LightDirection: TowardLight | FromLight | PositionAlone | FromObjectOrigin;
    /// The length of L, if a light has a position.
    LightLength: Unit | NotNormalised;
    /// The space that the scene's lights are assumed to be in.
    LightSpace: World | Object | Eye | MovedToEye | EyeTurnedBackTwice;
    /// The axes of lights' directions and positions.
    LightAxes: AsGiven | XyExchanged | XzExchanged;
    /// The space that points are in when L and V are computed; lights and eye are in world space.
    PositionSpace: World | Eye;
    /// The coefficients ka, kd and ks.
    Coefficients: Right | Swapped | Decoded;
    /// The material of a polygon.
    Materials: Own | FirstOfMesh | OfFirstObject;
    /// The colour I_p of a light.
    LightColour: Own | White | OfFirstLight;
    /// The lights that count.
    Lights: Sum | First | Last | Mean;
    /// The value used for L·N.
    DiffuseCosine: Clamped | NotClamped | Absolute | Half | NormalView | Wrapped | Squared | OfAngle | FourSteps;
    /// The diffuse term.
    DiffuseTerm: Whole | Missing | OverPi | WithoutShine;
    /// The specular term.
    SpecularTerm: Whole | Missing | EnergyConserving | EnergyConservingLobe;
    /// The colour of the specular term.
    SpecularColour: LightTimesKs | LightTimesKd | KsAlone | HueOfKd;
    /// The factor of the specular term at grazing angles.
    Fresnel: Without | OneMinusCosine;
    /// The way in which ambient, diffuse and specular terms become one colour.
    Terms: Added | Mixed | MixedWithLight | AmbientIsLeast | LargerOfTwo;
    /// The ambient term.
    Ambient: Right | Missing | PerLight | WithoutKa | WithoutIa | TimesKd | Attenuated;
    /// The cosine that is raised to the exponent.
    HighlightCosine: OfScene | NormalView | NormalLight | OtherModel;
    /// The reflected vector R.
    Reflection: Right | Negated | WithoutTwo | OfView | BracketedDifference | UnitBracketedDifference;
    /// The vector H halfway between L and V.
    HalfVector: Unit | NotNormalised | Mean | Difference | OfDistances | Constant;
    /// The cosine of a highlight if it is below 0.
    SpecularClamp: Clamped | NotClamped;
    /// Highlights of lights behind the surface.
    Gate: OfScene | Missing | TimesDiffuse;
    /// The exponent.
    Exponent: Right | Missing | Factor | Times128 | OfProduct | NotConverted | DividedByFour;
    /// The vector V.
    View: OfScene | Negated | AlongZ | AlwaysAtEye | AlwaysFarAway | TowardOrigin | OfTwoSpaces | DifferenceOfUnits | AtVertices;
    /// The length of V, if the eye has a position.
    ViewLength: Unit | NotNormalised;
    /// The falloff of lights at positions.
    Falloff: OfScene | Missing | NotSquared | Multiplied | InverseSquare | DiffuseOnly;
    /// The place where light is computed.
    Rate: Pixel | Vertex | Face | FirstVertex | MeanNormal;
    /// The interpolated normal at a pixel.
    PixelNormal: Normalised | AsInterpolated | ReflectionAlone | NotInHighlights | RootInHighlights;
    /// The side to which a normal points.
    NormalSign: Outside | TowardViewer;

    /// The transform from model space to world space.
    ModelMatrix: Right | Transposed | Missing;
    /// The normal of a polygon.
    PolygonNormal: Newell | Reversed | FirstCorner;
    /// The vectors that are summed at a vertex.
    VertexNormal: UnitNormals | AreaWeighted | AngleWeighted | LastPolygon | EachTriangle | SumKept;
    /// The source of vertex normals.
    NormalSource: OfScene | AlwaysAveraged | AlwaysGiven | WithoutCrease | Positions;
    /// The vertex whose normal a vertex has.
    NormalIndex: Own | Before | After;
    /// The axes of normals, in model space.
    NormalAxes: AsGiven | XNegated | YNegated | ZNegated | XyExchanged | XzExchanged | YzExchanged;
    /// The numbers that stand for a normal.
    NormalCode: Plain | Halved;
    /// The transform of normals from model space to world space.
    NormalTransform: InverseTranspose | Matrix | Inverse | Missing | AsPoint;
    /// The space that normals are in when light is computed; lights are in world space.
    NormalSpace: World | Eye;
    /// The fourth component of normals behind a matrix of four rows.
    NormalW: Dropped | OfTarget | OfEye;

    /// The scale of a perspective picture.
    FieldOfView: Right | Degrees | NotHalved | Horizontal;
    /// The scale of an orthographic picture.
    HalfHeight: Right | TakenAsHeight;
    /// The aspect ratio of the picture.
    Aspect: Right | Missing | Inverted | OnHeight;
    /// The vector to the right of the camera.
    CameraRight: ForwardTimesUp | UpTimesForward;
    /// The vector upward of the camera.
    CameraUp: Perpendicular | AsGiven;
    /// The transform from world space to the camera's space.
    ViewMatrix: Right | Transposed | TranslatedLast;
    /// The division by w.
    Division: ByW | Missing;
    /// The way from device coordinates to pixels.
    Viewport: Right | UpsideDown | LessOnePixel;
    /// The point of a pixel that is tested.
    SamplePoint: Centre | Corner;
    /// Corners of polygons on the screen.
    ScreenCorners: Exact | WholePixels | WholePixelsTestedThere | CutDown | CutDownTestedThere;

    /// Polygons seen from behind.
    Culling: OfScene | Missing | Reversed;
    /// The winding of polygons after a mirroring transform.
    MirroredWinding: Restored | Forgotten;
    /// The depth test.
    Depth: Nearest | Farthest | Missing | StartsAtZero | OfTriangle | TiesToLast;
    /// The triangles of a polygon.
    Triangles: Right | FanAlways | FirstThree | Strip;
    /// The weights of the three corners of a triangle.
    Weights: Right | Rotated;
    /// The variation of normals and positions over the screen.
    Interpolation: OfScene | OnScreen | TimesW;
    /// The end of a triangle's bounding box.
    BoxEnd: Inclusive | Exclusive;

    /// The transfer function.
    Encoding: OfScene | Linear | Srgb | Gamma22 | SrgbTwice | Decoded;
    /// The conversion from 0..=1 to 0..=255.
    Rounding: Nearest | Down | Times256;
    /// The treatment of colours brighter than 1.
    Overflow: Clamped | Wraps | DividedByBrightest | DividedByOwnLargest | ToneMapped;
    /// The order of channels.
    Channels: Rgb | Bgr | Grey | Grb | Rbg;
    /// The colour where nothing is drawn.
    Background: OfScene | Black | White;
    /// The order of pixels in the file.
    Layout: Rows | RightToLeft | HalfTurn | Columns | OneRowDown | OneRightAndUp | OneLeftAndDown;
}

/// The way in which a renderer does each step. The default does all steps right.
#[derive(Clone, Debug, Default)]
pub struct Options {
    pub light_direction: LightDirection,
    pub light_length: LightLength,
    pub light_space: LightSpace,
    pub light_axes: LightAxes,
    pub position_space: PositionSpace,
    pub coefficients: Coefficients,
    pub materials: Materials,
    pub light_colour: LightColour,
    pub lights: Lights,
    pub diffuse_cosine: DiffuseCosine,
    pub diffuse_term: DiffuseTerm,
    pub specular_term: SpecularTerm,
    pub specular_colour: SpecularColour,
    pub fresnel: Fresnel,
    pub terms: Terms,
    pub ambient: Ambient,
    pub highlight_cosine: HighlightCosine,
    pub reflection: Reflection,
    pub half_vector: HalfVector,
    pub specular_clamp: SpecularClamp,
    pub gate: Gate,
    pub exponent: Exponent,
    pub view: View,
    pub view_length: ViewLength,
    pub falloff: Falloff,
    pub rate: Rate,
    pub pixel_normal: PixelNormal,
    pub normal_sign: NormalSign,
    pub model_matrix: ModelMatrix,
    pub polygon_normal: PolygonNormal,
    pub vertex_normal: VertexNormal,
    pub normal_source: NormalSource,
    pub normal_index: NormalIndex,
    pub normal_axes: NormalAxes,
    pub normal_code: NormalCode,
    pub normal_transform: NormalTransform,
    pub normal_space: NormalSpace,
    pub normal_w: NormalW,
    pub field_of_view: FieldOfView,
    pub half_height: HalfHeight,
    pub aspect: Aspect,
    pub camera_right: CameraRight,
    pub camera_up: CameraUp,
    pub view_matrix: ViewMatrix,
    pub division: Division,
    pub viewport: Viewport,
    pub sample_point: SamplePoint,
    pub screen_corners: ScreenCorners,
    pub culling: Culling,
    pub mirrored_winding: MirroredWinding,
    pub depth: Depth,
    pub triangles: Triangles,
    pub weights: Weights,
    pub interpolation: Interpolation,
    pub box_end: BoxEnd,
    pub encoding: Encoding,
    pub rounding: Rounding,
    pub overflow: Overflow,
    pub channels: Channels,
    pub background: Background,
    pub layout: Layout,
}
