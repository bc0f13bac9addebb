//! Flags that change the scene: what they say stands over what the scene file says, and is checked with it.

use super::Failure;
use super::talk::Talk;
use super::values::{self, Normals};
use fastphong::picture::Encoding;
use fastphong::scene::file::resolve::Resolved;
use fastphong::scene::file::value::{Located, OneOrThree};
use fastphong::scene::file::{
    CameraSection, FalloffChoice, ImageSection, LightSection, MaterialSection, SceneFile,
    ViewerChoice, VisibilityChoice,
};
use fastphong::scene::{
    Clipping, Culling, DepthSource, Interpolation, PainterKey, SpecularGate, SpecularModel, input,
};

/// The picture and the scene.
#[derive(clap::Args, Clone, Debug, Default)]
#[command(next_help_heading = "Scene")]
pub struct SceneFlags {
    /// Size of the picture, 1x1 to 16384x16384 [default: that of the scene, 640x480]
    #[arg(long, visible_alias = "size", value_name = "WIDTHxHEIGHT", value_parser = values::size, allow_hyphen_values = true)]
    resolution: Option<[i64; 2]>,
    /// See the scene from this direction, in degrees: 0,0 is from +z, azimuth turns toward +x, elevation toward +y (up)
    #[arg(long, value_name = "AZIMUTH,ELEVATION", value_parser = values::pair, allow_hyphen_values = true)]
    view: Option<[f64; 2]>,
    /// Put the eye here
    #[arg(long, value_name = "X,Y,Z", value_parser = values::triple, allow_hyphen_values = true)]
    eye: Option<[f64; 3]>,
    /// Look at this point [default, with --eye: the origin]
    #[arg(long, value_name = "X,Y,Z", value_parser = values::triple, allow_hyphen_values = true)]
    target: Option<[f64; 3]>,
    /// The direction that is upward in the picture [default: y]
    #[arg(long, value_name = "X,Y,Z", value_parser = values::triple, allow_hyphen_values = true)]
    up: Option<[f64; 3]>,
    /// Perspective, with this vertical field of view
    #[arg(long, value_name = "DEGREES", allow_hyphen_values = true)]
    fovy: Option<f64>,
    /// Orthographic: half of the height that is seen
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true)]
    half_height: Option<f64>,
    /// Distance of the near plane
    #[arg(long, value_name = "DISTANCE", allow_hyphen_values = true)]
    near: Option<f64>,
    /// Distance of the far plane
    #[arg(long, value_name = "DISTANCE", allow_hyphen_values = true)]
    far: Option<f64>,
    /// Fit the camera: the objects fill this part of the frame
    #[arg(long, value_name = "PART", allow_hyphen_values = true)]
    fit: Option<f64>,
    /// A light from this direction, instead of those of the scene; can be given several times
    #[arg(long, value_name = "X,Y,Z[,I|,R,G,B]", value_parser = values::light, allow_hyphen_values = true)]
    light: Vec<LightSection>,
    /// A light at this position, likewise
    #[arg(long, value_name = "X,Y,Z[,I|,R,G,B]", value_parser = values::light_at, allow_hyphen_values = true)]
    light_at: Vec<LightSection>,
    /// Attenuation 1 / (1 + k d²) of the lights given by --light-at
    #[arg(
        long,
        value_name = "K",
        allow_hyphen_values = true,
        requires = "light_at"
    )]
    attenuation: Option<f64>,
    /// How they grow weaker instead: 1 / r² or 1 / r
    #[arg(long, value_name = "HOW", value_parser = values::word::<FalloffChoice>(), requires = "light_at")]
    falloff: Option<FalloffChoice>,
    /// No lights: ambient light only
    #[arg(long, conflicts_with_all = ["light", "light_at"])]
    no_lights: bool,
    /// Ambient intensity
    #[arg(long, value_name = "I|R,G,B", value_parser = values::one_or_three, allow_hyphen_values = true)]
    ambient: Option<OneOrThree>,
    /// Ambient reflection of all objects; materials that come with a mesh file are replaced
    #[arg(long, value_name = "K|R,G,B", value_parser = values::one_or_three, allow_hyphen_values = true)]
    ka: Option<OneOrThree>,
    /// Diffuse reflection of all objects, likewise
    #[arg(long, value_name = "K|R,G,B", value_parser = values::one_or_three, allow_hyphen_values = true)]
    kd: Option<OneOrThree>,
    /// Specular reflection of all objects, likewise
    #[arg(long, value_name = "K|R,G,B", value_parser = values::one_or_three, allow_hyphen_values = true)]
    ks: Option<OneOrThree>,
    /// Exponent of the highlight of all objects, likewise
    #[arg(long, value_name = "N", allow_hyphen_values = true)]
    shininess: Option<f64>,
    /// Colour where nothing is drawn
    #[arg(long, value_name = "C|R,G,B", value_parser = values::one_or_three, allow_hyphen_values = true)]
    background: Option<OneOrThree>,
    /// How attributes vary: linearly on the screen, as in the lecture, or linearly in space
    #[arg(long, value_name = "HOW", value_parser = values::word::<Interpolation>())]
    interpolation: Option<Interpolation>,
    /// Where the eye is for the highlights: at infinity, as in the lecture, or where the camera is
    #[arg(long, value_name = "WHERE", value_parser = values::word::<ViewerChoice>())]
    viewer: Option<ViewerChoice>,
    /// The cosine of the highlights: phong (R.V) or blinn (N.H)
    #[arg(long, value_name = "MODEL", value_parser = values::word::<SpecularModel>())]
    specular: Option<SpecularModel>,
    /// The cosine that exponents are meant for; they are converted if it is not that of --specular
    #[arg(long, value_name = "MODEL", value_parser = values::word::<SpecularModel>())]
    shininess_for: Option<SpecularModel>,
    /// What becomes of highlights where the light is behind the surface
    #[arg(long, value_name = "HOW", value_parser = values::word::<SpecularGate>())]
    specular_gate: Option<SpecularGate>,
    /// How values are stored in 8 bits
    #[arg(long, value_name = "HOW", value_parser = values::word::<Encoding>())]
    encoding: Option<Encoding>,
    /// Which polygons are left out
    #[arg(long, value_name = "SIDE", value_parser = values::word::<Culling>())]
    cull: Option<Culling>,
    /// What hides a polygon: a nearer sample, or what is drawn later, sorted from back to front or not
    #[arg(long, value_name = "HOW", value_parser = values::word::<VisibilityChoice>())]
    visibility: Option<VisibilityChoice>,
    /// Bits of the depth buffer: 16, 24 or 32
    #[arg(long, value_name = "BITS", allow_hyphen_values = true)]
    depth_bits: Option<i64>,
    /// Where depth comes from: interpolated between corners, or computed from the distance at each sample
    #[arg(long, value_name = "HOW", value_parser = values::word::<DepthSource>())]
    depth: Option<DepthSource>,
    /// By what the painter sorts: the mean depth of the corners or that of the farthest one
    #[arg(long, value_name = "KEY", value_parser = values::word::<PainterKey>())]
    painter_key: Option<PainterKey>,
    /// What keeps polygons within the view: clipping by planes, or CS171's test of each pixel
    #[arg(long, value_name = "HOW", value_parser = values::word::<Clipping>())]
    clipping: Option<Clipping>,
    /// Light polygons seen from behind with negated normals (with `--cull none`)
    #[arg(long)]
    two_sided: bool,
    /// Supersampling: so many samples a pixel along each side, 1, 2, 4 or 8, hidden and shaded each on its own
    #[arg(long, value_name = "N", allow_hyphen_values = true)]
    samples: Option<i64>,
    /// Where vertex normals come from: `averaged`, `given`, or averaged up to an angle, `crease=30`
    #[arg(long, value_name = "SOURCE", value_parser = values::normals)]
    normals: Option<Normals>,
}

fn flag<T: Copy>(value: Option<T>, name: &str) -> Option<Located<T>> {
    value.map(|value| Located::flag(value, name))
}

impl SceneFlags {
    /// The scene that `input` names, with what the flags change.
    ///
    /// # Errors
    /// When there is no such input.
    pub fn load(&self, input: &str) -> Result<SceneFile, Failure> {
        let mut file = input::load(input)?;
        file.overlay(self.overlay());
        self.change_objects(&mut file);
        Ok(file)
    }

    /// True if a flag gives the size of the picture.
    pub fn has_size(&self) -> bool {
        self.resolution.is_some()
    }

    /// Says what is odd about a scene.
    pub fn warn(&self, resolved: &Resolved, talk: Talk) {
        for warning in &resolved.warnings {
            talk.warning(warning);
        }
        let with_own = resolved
            .scene
            .objects
            .iter()
            .filter(|object| !object.mesh.materials().is_empty())
            .count();
        if with_own > 0 && !self.material().is_empty() {
            talk.note("the material given by flags replaces those of the mesh file");
        }
    }

    fn material(&self) -> MaterialSection {
        MaterialSection {
            ka: flag(self.ka, "--ka"),
            kd: flag(self.kd, "--kd"),
            ks: flag(self.ks, "--ks"),
            shininess: flag(self.shininess, "--shininess"),
        }
    }

    fn camera(&self) -> CameraSection {
        CameraSection {
            eye: flag(self.eye, "--eye"),
            target: flag(self.target, "--target"),
            up: flag(self.up, "--up"),
            half_height: flag(self.half_height, "--half-height"),
            fovy: flag(self.fovy, "--fovy"),
            near: flag(self.near, "--near"),
            far: flag(self.far, "--far"),
            fit: flag(self.fit, "--fit"),
            direction: None,
            azimuth: flag(self.view.map(|view| view[0]), "--view"),
            elevation: flag(self.view.map(|view| view[1]), "--view"),
        }
    }

    /// What the flags say, as a scene file.
    fn overlay(&self) -> SceneFile {
        let mut over = SceneFile::default();
        over.image = ImageSection {
            width: flag(self.resolution.map(|sides| sides[0]), "--resolution"),
            height: flag(self.resolution.map(|sides| sides[1]), "--resolution"),
            background: flag(self.background, "--background"),
            encoding: flag(self.encoding, "--encoding"),
            samples: flag(self.samples, "--samples"),
        };
        over.camera = self.camera();
        over.material = self.material();
        over.ambient = flag(self.ambient, "--ambient");
        over.interpolation = flag(self.interpolation, "--interpolation");
        over.cull = flag(self.cull, "--cull");
        over.visibility = flag(self.visibility, "--visibility");
        over.depth_bits = flag(self.depth_bits, "--depth-bits");
        over.depth = flag(self.depth, "--depth");
        over.clipping = flag(self.clipping, "--clipping");
        over.two_sided = self.two_sided.then(|| Located::flag(true, "--two-sided"));
        over.painter_key = flag(self.painter_key, "--painter-key");
        over.viewer = flag(self.viewer, "--viewer");
        over.specular = flag(self.specular, "--specular");
        over.shininess_for = flag(self.shininess_for, "--shininess-for");
        over.specular_gate = flag(self.specular_gate, "--specular-gate");
        if self.no_lights || !self.light.is_empty() || !self.light_at.is_empty() {
            let attenuated = |light: &LightSection| LightSection {
                attenuation: flag(self.attenuation, "--attenuation"),
                falloff: flag(self.falloff, "--falloff"),
                ..light.clone()
            };
            over.light = Some(
                self.light
                    .iter()
                    .cloned()
                    .chain(self.light_at.iter().map(attenuated))
                    .collect(),
            );
        }
        over
    }

    /// Flags that are about every object, whatever a scene file says of it.
    fn change_objects(&self, file: &mut SceneFile) {
        let material = self.material();
        for object in &mut file.object {
            if !material.is_empty() {
                let own = object.material.take().unwrap_or_default();
                object.material = Some(material.clone().or(&own));
            }
            match self.normals {
                None => {}
                Some(Normals::Choice(choice)) => {
                    object.normals = Some(Located::flag(choice, "--normals"));
                    object.crease = None;
                }
                Some(Normals::Crease(degrees)) => {
                    object.normals = None;
                    object.crease = Some(Located::flag(degrees, "--normals"));
                }
            }
        }
    }
}
