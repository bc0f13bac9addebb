use crate::picture::Encoding;
use crate::scene::file::value::{Choice, Located, OneOrThree};
use crate::scene::file::{
    CameraSection, FalloffChoice, ImageSection, LightSection, MaterialSection, NormalChoice,
    ObjectSection, RotationSection, Rotations, SceneFile, ViewerChoice, VisibilityChoice,
};
use crate::scene::{
    Clipping, Culling, DepthSource, Interpolation, PainterKey, SpecularGate, SpecularModel,
};
use std::format;
use std::string::String;

/// A fixed sequence of numbers that look random: splitmix64 (Steele, Lea, Flood, OOPSLA 2014).
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// Any finite double, all exponents alike; now and then a round one.
    fn number(&mut self) -> f64 {
        match self.next() % 4 {
            0 => [0.0, -0.0, 1.0, -2.0, 0.1, 1e300, 5e-324, 1e21][self.next() as usize % 8],
            _ => Some(f64::from_bits(self.next()))
                .filter(|v| v.is_finite())
                .unwrap_or(0.5),
        }
    }

    fn triple(&mut self) -> [f64; 3] {
        [self.number(), self.number(), self.number()]
    }

    fn one_or_three(&mut self) -> OneOrThree {
        if self.next().is_multiple_of(2) {
            OneOrThree::splat(self.number())
        } else {
            OneOrThree(self.triple())
        }
    }

    /// Given in half of all cases.
    fn maybe<T>(&mut self, make: impl FnOnce(&mut Self) -> T) -> Option<Located<T>> {
        (self.next().is_multiple_of(2)).then(|| make(self).into())
    }

    fn choice<T: Copy>(&mut self, of: &[T]) -> T {
        of[self.next() as usize % of.len()]
    }

    fn text(&mut self) -> String {
        let pieces = [
            "a", "\"", "'", "\\", "\n", "\t", "'''", "\"\"\"", "ä", "😀", "#", "=", "[x]",
            "\u{7f}", " ", "\r",
        ];
        (0..self.next() % 6).map(|_| self.choice(&pieces)).collect()
    }

    fn material(&mut self) -> MaterialSection {
        MaterialSection {
            ka: self.maybe(Self::one_or_three),
            kd: self.maybe(Self::one_or_three),
            ks: self.maybe(Self::one_or_three),
            shininess: self.maybe(Self::number),
        }
    }

    fn light(&mut self) -> LightSection {
        LightSection {
            table: Located::default(),
            direction: self.maybe(Self::triple),
            position: self.maybe(Self::triple),
            colour: self.maybe(Self::one_or_three),
            intensity: self.maybe(Self::number),
            attenuation: self.maybe(Self::number),
            falloff: self.maybe(|r| r.choice(FalloffChoice::MEANINGS)),
        }
    }

    fn object(&mut self) -> ObjectSection {
        let turns = self.next() % 4;
        let rotation = |r: &mut Self| RotationSection {
            axis: r.triple().into(),
            angle: r.number().into(),
        };
        ObjectSection {
            mesh: self.text().into(),
            normals: self.maybe(|r| r.choice(&[NormalChoice::Given, NormalChoice::Averaged])),
            crease: self.maybe(Self::number),
            scale: self.maybe(Self::one_or_three),
            rotate: (turns > 0).then(|| Rotations((1..turns).map(|_| rotation(self)).collect())),
            translate: self.maybe(Self::triple),
            matrix: self.maybe(|r| [0; 3].map(|_| [0; 4].map(|_| r.number()))),
            material: self.maybe(Self::material).map(|given| given.value),
        }
    }

    fn scene(&mut self) -> SceneFile {
        let (lights, objects) = (self.next() % 4, self.next() % 3);
        SceneFile {
            title: self.maybe(Self::text),
            description: self.maybe(Self::text),
            ambient: self.maybe(Self::one_or_three),
            viewer: self.maybe(|r| r.choice(ViewerChoice::MEANINGS)),
            specular: self.maybe(|r| r.choice(SpecularModel::MEANINGS)),
            shininess_for: self.maybe(|r| r.choice(SpecularModel::MEANINGS)),
            specular_gate: self.maybe(|r| r.choice(SpecularGate::MEANINGS)),
            interpolation: self
                .maybe(|r| r.choice(&[Interpolation::Screen, Interpolation::Perspective])),
            cull: self.maybe(|r| r.choice(&[Culling::Back, Culling::Front, Culling::None])),
            visibility: self.maybe(|r| r.choice(VisibilityChoice::MEANINGS)),
            clipping: self.maybe(|r| r.choice(Clipping::MEANINGS)),
            two_sided: self.maybe(|r| r.choice(&[true, false])),
            depth_bits: self.maybe(|r| r.next() as i64),
            depth: self.maybe(|r| r.choice(DepthSource::MEANINGS)),
            painter_key: self.maybe(|r| r.choice(PainterKey::MEANINGS)),
            image: ImageSection {
                width: self.maybe(|r| r.next() as i64),
                height: self.maybe(|r| r.next() as i64),
                background: self.maybe(Self::one_or_three),
                encoding: self.maybe(|r| r.choice(&[Encoding::Linear, Encoding::Srgb])),
                samples: self.maybe(|r| r.next() as i64),
            },
            camera: CameraSection {
                eye: self.maybe(Self::triple),
                target: self.maybe(Self::triple),
                up: self.maybe(Self::triple),
                half_height: self.maybe(Self::number),
                fovy: self.maybe(Self::number),
                near: self.maybe(Self::number),
                far: self.maybe(Self::number),
                fit: self.maybe(Self::number),
                direction: self.maybe(Self::triple),
                azimuth: self.maybe(Self::number),
                elevation: self.maybe(Self::number),
            },
            material: self.material(),
            light: (lights > 0).then(|| (1..lights).map(|_| self.light()).collect()),
            object: (0..objects).map(|_| self.object()).collect(),
            ..SceneFile::default()
        }
    }
}

/// What is written reads back as the same scene, values bit for bit, however odd they are.
#[test]
fn written_scenes_read_back_equal() {
    let mut random = Random(21);
    for round in 0..2000 {
        let scene = random.scene();
        let text = scene.to_toml();
        let back = SceneFile::parse(&text, "back.toml")
            .unwrap_or_else(|error| panic!("{round}: {error}\n{text}"));
        assert_eq!(back, scene, "{round}:\n{text}");
        // `==` does not tell −0 from 0; the text does.
        assert_eq!(back.to_toml(), text, "{round}");
    }
}

#[test]
fn the_scene_of_a_mesh_is_spelt_out() {
    let scene = SceneFile::for_mesh(String::from("teapot.obj"));
    assert_eq!(
        scene.to_toml(),
        "\
ambient = 1.0

[image]
width = 640
height = 480
background = 0.0

[camera]
fit = 0.8
direction = [0.5, 0.3, 1.0]

[material]
ka = [0.08, 0.07, 0.06]
kd = [0.6, 0.45, 0.3]
ks = 0.4
shininess = 32.0

[[light]]
direction = [0.4, 0.7, 0.9]

[[object]]
mesh = \"teapot.obj\"
"
    );
    // Spelt out, and yet the defaults: a scene that says nothing but the mesh is the same scene.
    let bare = SceneFile::parse("[[object]]\nmesh = 'teapot.obj'", "bare.toml").expect("valid");
    let resolved = |file: &SceneFile| format!("{:?}", file.resolve(super::cubes).expect("valid"));
    assert_eq!(resolved(&scene), resolved(&bare));
}
