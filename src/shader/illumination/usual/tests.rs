use super::super::Illumination;
use crate::lighting::{Light, Lighting, Material, SpecularGate, SpecularModel};
use crate::number::{Lanes, LanesJob, Level, on_level};
use crate::test_random::Random;
use alloc::vec::Vec;
use glam::DVec3;

/// Four lights from all sides on a surface of this shininess, seen along z.
fn lighting(random: &mut Random, shininess: f32) -> Lighting {
    let mut direction = || DVec3::from([0; 3].map(|_| f64::from(random.signed()))).normalize();
    let lights: Vec<Light> = (0..4)
        .map(|i| Light::directional(direction(), [0.9, 0.2, 0.1 * i as f32]))
        .collect();
    Lighting::new(
        &Material {
            shininess,
            ..Material::default()
        },
        [1.0; 3],
        &lights,
        DVec3::Z,
    )
}

/// The colour at a unit normal, if `USUAL` with constants that are.
fn colour<const USUAL: bool>(model: &Illumination<f32, 4>, n: [f32; 3]) -> [f32; 3] {
    let far = model.far();
    let j = far.light_cosines(n);
    model.colour_of_unit_cosines::<USUAL>(|i| j[i], far.view_cosine(n), &far.scalars)
}

/// At scale 1 the colours are those of the general sum, to the last bit.
#[test]
fn usual_constants_give_the_same_colours() {
    let mut random = Random::new(21);
    for shininess in (0..8).map(|k| (1 << k) as f32) {
        for _ in 0..20 {
            let lighting = lighting(&mut random, shininess);
            let general = Illumination::<f32, 4>::new(&lighting, &|x| x);
            let usual = general.usual(1.0).expect("what most scenes ask for");
            for _ in 0..200 {
                let n = [0; 3].map(|_| random.signed());
                let length = n.iter().map(|x| x * x).sum::<f32>().sqrt();
                let n = n.map(|x| x / length);
                assert_eq!(
                    colour::<true>(&usual, n),
                    colour::<false>(&general, n),
                    "shininess {shininess}, {n:?}"
                );
            }
        }
    }
}

#[test]
fn colours_are_scaled() {
    let lighting = lighting(&mut Random::new(2), 32.0);
    let all = Illumination::<f32, 4>::new(&lighting, &|x| x);
    // A power of two scales without rounding.
    let (one, four) = (
        all.usual(1.0).expect("usual"),
        all.usual(4.0).expect("usual"),
    );
    let n = [0.6, 0.0, 0.8];
    assert_eq!(
        colour::<true>(&four, n),
        colour::<true>(&one, n).map(|c| 4.0 * c)
    );
}

#[test]
fn what_is_unusual_is_not_taken_for_usual() {
    let lighting = lighting(&mut Random::new(1), 32.0);
    let is_usual = |change: &dyn Fn(&mut Lighting)| {
        let mut lighting = lighting.clone();
        change(&mut lighting);
        Illumination::<f32, 4>::new(&lighting, &|x| x)
            .usual(255.0)
            .is_some()
    };
    assert!(is_usual(&|_| ()));
    assert!(is_usual(&|l| l.shininess = 1.0));
    for shininess in [0.0, 0.5, 3.0, 24.0, 32.5, 256.0] {
        assert!(!is_usual(&|l| l.shininess = shininess), "{shininess}");
    }
    assert!(!is_usual(&|l| l.specular = SpecularModel::Blinn));
    assert!(!is_usual(&|l| l.gate = SpecularGate::Ungated));
    assert!(!is_usual(&|l| l.gate = SpecularGate::Weighted));
    // 255 times this is more than 32 bits hold.
    assert!(!is_usual(&|l| l.ambient[1] = 1e7));
    assert!(!is_usual(&|l| l.lights[3].specular[2] = 1e7));
    assert!(!is_usual(&|l| l.lights[0].diffuse[0] = f32::INFINITY));
}

/// The colours at these unit normals: of groups of pixels, or each with its pixel's normal everywhere in its group.
struct Lit<'a> {
    lighting: &'a Lighting,
    normals: &'a [[f32; 3]],
    alone: bool,
}

impl LanesJob for Lit<'_> {
    type Out = Vec<[u32; 3]>;

    fn run<M: Lanes>(self, m: M) -> Vec<[u32; 3]> {
        let model = Illumination::<M::F, 4>::new(self.lighting, &|x| m.splat(x))
            .usual(m.splat(255.0))
            .expect("usual");
        let of = |normals: [[f32; 8]; 3]| {
            let n = normals.map(|line| m.load(&line));
            let (j, k) = (model.far().light_cosines(n), model.far().view_cosine(n));
            let colour = model.colour_of_unit_cosines::<true>(|i| j[i], k, &model.far().scalars);
            colour.map(|c| {
                let mut line = [0.0; 8];
                m.store(c, &mut line);
                line.map(f32::to_bits)
            })
        };
        let each = self.normals.chunks_exact(M::WIDTH).flat_map(|group| {
            let together = of([0, 1, 2].map(|c| core::array::from_fn(|k| group[k % M::WIDTH][c])));
            (0..M::WIDTH).map(move |k| match self.alone {
                true => of([0, 1, 2].map(|c| [group[k][c]; 8])).map(|line| line[k]),
                false => together.map(|line| line[k]),
            })
        });
        each.collect()
    }
}

/// What lies beside a pixel decides what is computed, not what comes out: bands are drawn into memory that others have used.
#[test]
fn pixels_do_not_depend_on_their_neighbours() {
    let mut random = Random::new(4);
    let lighting = lighting(&mut random, 8.0);
    let normals: Vec<[f32; 3]> = (0..800)
        .map(|_| {
            DVec3::from([0; 3].map(|_| f64::from(random.signed())))
                .normalize()
                .as_vec3()
                .to_array()
        })
        .collect();
    for level in Level::available() {
        let colours = [true, false].map(|alone| {
            on_level(
                level,
                Lit {
                    lighting: &lighting,
                    normals: &normals,
                    alone,
                },
            )
        });
        for (i, (alone, together)) in colours[0].iter().zip(&colours[1]).enumerate() {
            assert_eq!(alone, together, "{level}, {:?}", normals[i]);
        }
    }
}
