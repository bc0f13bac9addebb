use crate::note::Notes;
use crate::number::split_mix::SplitMix;
use crate::scene::file::SceneFile;
use crate::scene::file::diagnostics::Origin;
use crate::scene::file::schema::{AXES, SCENE, ValueKind};
use crate::scene::file::value::{Data, SceneTable};
use std::format;
use std::string::String;
use std::vec::Vec;

/// A random scene file.
struct Random(SplitMix);

impl Random {
    fn next(&mut self) -> u64 {
        self.0.next()
    }

    /// Returns any finite double, with all exponents equally likely, and sometimes a round one.
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

    /// Returns a value of a kind.
    fn data(&mut self, kind: ValueKind) -> Data {
        match kind {
            ValueKind::Text => Data::Text(self.text()),
            ValueKind::Switch => Data::Switch(self.choice(&[true, false])),
            ValueKind::Whole => Data::Whole(self.next() as i64),
            ValueKind::Number => Data::Number(self.number()),
            ValueKind::OneOrThree if self.next().is_multiple_of(2) => {
                Data::Triple([self.number(); 3])
            }
            ValueKind::Axis if self.next().is_multiple_of(2) => {
                Data::Text(self.choice(AXES).into())
            }
            ValueKind::Triple | ValueKind::OneOrThree | ValueKind::Axis => {
                Data::Triple(self.triple())
            }
            ValueKind::Matrix => Data::Matrix([0; 3].map(|_| [0; 4].map(|_| self.number()))),
            ValueKind::Word(words) => Data::Text(self.choice(words).into()),
            ValueKind::Table(_) => Data::Table(self.table(kind)),
            ValueKind::Tables(_) | ValueKind::Turns => self.tables(kind),
        }
    }

    fn tables(&mut self, kind: ValueKind) -> Data {
        let count = self.next() % 4;
        Data::Tables((0..count).map(|_| self.table(kind)).collect::<Vec<_>>())
    }

    /// Returns a table in which each key is present half of the time.
    fn table(&mut self, kind: ValueKind) -> SceneTable {
        let mut table = SceneTable::default();
        for key in kind.keys() {
            if key.needed || self.next().is_multiple_of(2) {
                table.set(key.name(), self.data(key.kind), Origin::Program);
            }
        }
        table
    }

    fn scene(&mut self) -> SceneFile {
        let mut table = self.table(SCENE);
        // An empty table equals a missing one, except for the material of an object.
        table
            .entries
            .retain(|_, value| !matches!(&value.data, Data::Table(t) if t.entries.is_empty()));
        SceneFile {
            table,
            source: None,
            notes: Notes::default(),
            of_mesh_file: SceneTable::default(),
        }
    }
}

/// A written scene reads back as an equal scene, with equal bits of every value.
#[test]
fn written_scenes_read_back_equal() {
    let mut random = Random(SplitMix(21));
    for round in 0..2000 {
        let scene = random.scene();
        let text = scene.to_toml();
        let back = SceneFile::parse(&text, "back.toml")
            .unwrap_or_else(|error| panic!("{round}: {error}\n{text}"));
        assert_eq!(back, scene, "{round}:\n{text}");
        // `==` does not distinguish −0 from 0, but the text does.
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
colours = \"on\"

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
    // The written defaults equal a scene that names only the mesh.
    let bare = "colours = 'on'\n[[object]]\nmesh = 'teapot.obj'";
    let bare = SceneFile::parse(bare, "bare.toml").expect("valid");
    let resolved = |file: &SceneFile| format!("{:?}", file.resolve(super::cubes).expect("valid"));
    assert_eq!(resolved(&scene), resolved(&bare));
}
