//! Quadratics of the vectors toward lights and eye at positions: compared with the same quadratics
//! in `f64`, and with Phong's picture within their errors.

use crate::adaptive::asked;
use crate::support::Random;
use crate::support::differences::largest_difference;
use fastphong::frame::{Frame, FrameBuilder, SubPixel, Vertex};
use fastphong::mesh::Material;
use fastphong::reference::{self, Model};
use fastphong::scene::{Falloff, Interpolation, LightTerm, Lighting, Place, SpecularModel};
use fastphong::shading::Variant;
use glam::DVec3;

/// A triangle and its light. The corners lie in one half of the square picture.
struct Triangle {
    places: [[f64; 2]; 3],
    weights: [f32; 3],
    normals: [DVec3; 3],
    points: [DVec3; 3],
    lighting: Lighting,
}

const SIDE: u32 = 48;

impl Triangle {
    fn frame(&self) -> Frame {
        let mut builder = FrameBuilder::new(SIDE, SIDE);
        let material = builder.lighting(self.lighting.clone());
        builder.interpolation(Interpolation::Perspective);
        let corners = [0, 1, 2].map(|i| {
            let [x, y] = self.places[i].map(SubPixel::from_num);
            let corner = builder.vertex(Vertex {
                x,
                y,
                depth: 0.5,
                inv_w: self.weights[i].into(),
                normal: self.normals[i].as_vec3().to_array(),
                material,
            });
            builder.position(corner, self.points[i].as_vec3().to_array());
            corner
        });
        builder.polygon(&corners, [0.0, 0.0, 1.0], 0);
        builder.finish().expect("all corners are on the picture")
    }

    /// Returns the products at barycentric coordinates on the screen: K, then J, L·V and the
    /// strength of each light.
    fn products(&self, screen: [f64; 3]) -> Vec<f64> {
        let weighted = [0, 1, 2].map(|i| screen[i] * f64::from(self.weights[i]));
        let sum = |of: [DVec3; 3]| -> DVec3 { (0..3).map(|i| of[i] * weighted[i]).sum() };
        let (n, point) = (
            sum(self.normals).normalize(),
            sum(self.points) / weighted.iter().sum::<f64>(),
        );
        let to = |place: Place<[f32; 3]>| match place {
            Place::Infinite(v) => (DVec3::from_array(v.map(f64::from)), 0.0),
            Place::Local(p) => {
                let to = DVec3::from_array(p.map(f64::from)) - point;
                (to.normalize(), to.length())
            }
        };
        let (view, _) = to(self.lighting.view);
        let mut all = vec![view.dot(n)];
        for light in &self.lighting.lights {
            let (l, r) = to(light.place);
            let strength = match light.falloff {
                Falloff::None => 1.0,
                Falloff::Attenuation(k) => 1.0 / (1.0 + f64::from(k) * r * r),
                Falloff::InverseSquare => 1.0 / (r * r),
                Falloff::Inverse => 1.0 / r,
            };
            all.extend([l.dot(n), l.dot(view), strength]);
        }
        all
    }

    /// Returns the red light from the products.
    fn colour(&self, products: &[f64]) -> f64 {
        let lighting = &self.lighting;
        let k = products[0];
        let mut colour = f64::from(lighting.ambient[0]);
        for (light, of) in lighting.lights.iter().zip(products[1..].chunks(3)) {
            let &[j, l_v, strength] = of else {
                unreachable!("three products a light")
            };
            let cosine = match lighting.specular {
                SpecularModel::Phong => 2.0 * j * k - l_v,
                SpecularModel::Blinn => (j + k) / (2.0 + 2.0 * l_v).sqrt(),
            };
            let highlight = if j > 0.0 {
                cosine.max(0.0).powf(f64::from(lighting.shininess))
            } else {
                0.0
            };
            let [diffuse, specular] = [light.diffuse, light.specular].map(|c| f64::from(c[0]));
            colour += strength * (diffuse * j.max(0.0) + specular * highlight);
        }
        colour
    }

    /// Returns the barycentric coordinates of a point of the picture.
    fn barycentric(&self, [x, y]: [f64; 2]) -> [f64; 3] {
        let [a, b, c] = self.places;
        let area = |p: [f64; 2], q: [f64; 2], r: [f64; 2]| {
            (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])
        };
        let all = area(a, b, c);
        [
            area([x, y], b, c) / all,
            area(a, [x, y], c) / all,
            area(a, b, [x, y]) / all,
        ]
    }
}

/// Evaluates Lagrange's quadratic through the products at three corners and half-way along three
/// edges on the screen.
fn six_points(triangle: &Triangle, [a, b, c]: [f64; 3]) -> Vec<f64> {
    let weighted = [
        ([1.0, 0.0, 0.0], a * (2.0 * a - 1.0)),
        ([0.0, 1.0, 0.0], b * (2.0 * b - 1.0)),
        ([0.0, 0.0, 1.0], c * (2.0 * c - 1.0)),
        ([0.5, 0.5, 0.0], 4.0 * a * b),
        ([0.0, 0.5, 0.5], 4.0 * b * c),
        ([0.5, 0.0, 0.5], 4.0 * c * a),
    ];
    sum(weighted.map(|(at, weight)| (triangle.products(at), weight)))
}

/// Evaluates Taylor's quadratic about the middle, by second differences of the products themselves.
fn taylor(triangle: &Triangle, [_, b, c]: [f64; 3]) -> Vec<f64> {
    let h = 1e-3; // off by h²/6 of the third derivative, and by 2⁻⁵³/h² for rounding
    let third = 1.0 / 3.0;
    let at =
        |x: f64, y: f64| triangle.products([third - (x + y) * h, third + x * h, third + y * h]);
    let (x, y) = ((b - third) / h, (c - third) / h);
    let square = |x: f64| [(x * x - x) / 2.0, 1.0 - x * x, (x * x + x) / 2.0];
    let ([left, _, right], [up, _, down]) = (square(x), square(y));
    let across = x * y / 4.0;
    sum([
        (at(0.0, 0.0), 1.0 - x * x - y * y),
        (at(-1.0, 0.0), left),
        (at(1.0, 0.0), right),
        (at(0.0, -1.0), up),
        (at(0.0, 1.0), down),
        (at(1.0, 1.0), across),
        (at(-1.0, -1.0), across),
        (at(1.0, -1.0), -across),
        (at(-1.0, 1.0), -across),
    ])
}

fn sum<const N: usize>(weighted: [(Vec<f64>, f64); N]) -> Vec<f64> {
    let mut sum = vec![0.0; weighted[0].0.len()];
    for (products, weight) in weighted {
        for (sum, product) in sum.iter_mut().zip(products) {
            *sum += weight * product;
        }
    }
    sum
}

fn leaning(right: f64, up: f64) -> DVec3 {
    DVec3::new(right.to_radians().tan(), up.to_radians().tan(), 1.0).normalize()
}

fn light(place: Place<[f32; 3]>, falloff: Falloff, strength: f32) -> LightTerm {
    LightTerm {
        place,
        falloff,
        diffuse: [0.4 * strength; 3],
        specular: [0.3 * strength; 3],
    }
}

/// Builds a triangle a few lengths away from three lights, two of them at positions.
fn given(
    falloff: Falloff,
    specular: SpecularModel,
    weights: [f32; 3],
    eye: Place<[f32; 3]>,
) -> Triangle {
    let mut lighting = Lighting::new(&Material::default(), [0.0; 3], &[], DVec3::Z);
    lighting.ambient = [0.05; 3];
    lighting.view = eye;
    lighting.shininess = 12.0;
    lighting.specular = specular;
    lighting.lights = vec![
        light(Place::Local([1.0, 2.0, 4.0]), falloff, 1.0),
        light(Place::Infinite([0.6, 0.0, 0.8]), Falloff::None, 0.3),
        light(Place::Local([-3.0, 0.5, 3.0]), Falloff::Inverse, 0.8),
    ];
    Triangle {
        places: [[0.0, 0.0], [48.0, 4.0], [6.0, 48.0]],
        weights,
        normals: [leaning(-6.0, 5.0), leaning(7.0, 3.0), leaning(0.0, -8.0)],
        points: [
            DVec3::new(-0.5, 0.5, 0.1),
            DVec3::new(0.5, 0.4, 0.0),
            DVec3::new(-0.4, -0.5, -0.1),
        ],
        lighting,
    }
}

/// The quadratics light pixels for every falloff and both highlights, with and without perspective,
/// and with the eye at a position and at infinity.
///
/// Each product is off by 24 or 40 roundings of 2⁻²⁴, by 3 in each of 100 steps, and by 8 in the
/// formula's half-difference: e = 2.1e-5. N·H and R·V are off by up to 4 e, multiplied by n k_s =
/// 3.6 and the sum of the strengths, 2.1: 30 e.
#[test]
fn pixels_are_lit_by_quadratics() {
    type Quadratic = fn(&Triangle, [f64; 3]) -> Vec<f64>;
    let tolerance = 30.0 * 2.1e-5;
    let mut most = 0.0f64;
    for (name, quadratic) in [
        ("six-point", six_points as Quadratic),
        ("bishop-weimer", taylor as Quadratic),
    ] {
        let falloffs = [
            Falloff::None,
            Falloff::Attenuation(0.05),
            Falloff::InverseSquare,
            Falloff::Inverse,
        ];
        for falloff in falloffs {
            for specular in [SpecularModel::Phong, SpecularModel::Blinn] {
                for weights in [[1.0; 3], [0.8, 1.0, 0.9]] {
                    for eye in [
                        Place::Local([0.2, -0.3, 5.0]),
                        Place::Infinite([0.0, 0.0, 1.0]),
                    ] {
                        let triangle = given(falloff, specular, weights, eye);
                        let (frame, variant) =
                            (triangle.frame(), Variant::parse(name).expect("a method"));
                        let kinds = variant.polygon_kinds(&frame);
                        assert_eq!(kinds[0].polygons, 1, "{name}, {falloff:?}, {weights:?}");
                        let picture = variant
                            .render_linear(&frame)
                            .expect("a method for the frame");
                        let mut pixels = 0;
                        for y in 0..SIDE {
                            for (x, pixel) in picture.row(y as usize).iter().enumerate() {
                                if pixel[3] == 0.0 {
                                    continue;
                                }
                                pixels += 1;
                                let place = [x as f64 + 0.5, f64::from(y) + 0.5];
                                let products = quadratic(&triangle, triangle.barycentric(place));
                                let expected = triangle.colour(&products);
                                assert!(expected < 1.0, "a clamp would hide errors: {expected}");
                                let error = (f64::from(pixel[0]) - expected).abs();
                                assert!(
                                    error < tolerance,
                                    "{name}, {falloff:?}, {specular:?}, {weights:?}, {eye:?} at {place:?}: {error}"
                                );
                                most = most.max(error);
                            }
                        }
                        assert!(pixels > 900, "{pixels} pixels");
                    }
                }
            }
        }
    }
    println!("largest error {most:.2e} of {tolerance:.2e}");
}

/// Builds a random triangle, and one to three lights near it or far away.
fn random_triangle(random: &mut Random) -> Triangle {
    let mut signed = || 2.0 * f64::from(random.share()) - 1.0;
    let mut vector = || DVec3::from_array([signed(), signed(), signed()]);
    let middle = (vector() + DVec3::Z).normalize_or(DVec3::Z);
    let far = |share: DVec3| 10f64.powf(share.x); // a tenth to ten times the size of the triangle
    let reach = far(vector() - DVec3::X);
    let normals = [(); 3].map(|()| (middle + reach * vector()).normalize_or(middle));
    let plane = vector();
    let points = [(-1.0, 1.0), (1.0, 1.0), (-1.0, -1.0)]
        .map(|(x, y)| DVec3::new(x, y, plane.x * x + plane.y * y));
    let mut place = |is_local: bool| {
        let to = (vector() + DVec3::Z).normalize_or(DVec3::Z);
        let at = (1.5 + 4.0 * far(vector() + DVec3::X * 0.5)) * to;
        if is_local {
            Place::Local(at.as_vec3().to_array())
        } else {
            Place::Infinite(to.as_vec3().to_array())
        }
    };
    let places: Vec<_> = [true, true, false].map(&mut place).into();
    let mut eye = place(true);
    let change = vector() * 0.25;
    let count = 1 + random.below(3) as usize;
    if random.below(4) == 0 {
        eye = Place::Infinite([0.0, 0.0, 1.0]);
    }
    let falloff = [
        Falloff::None,
        Falloff::Attenuation(random.share()),
        Falloff::InverseSquare,
        Falloff::Inverse,
    ];
    let lights = places[..count].iter().map(|place| LightTerm {
        place: *place,
        falloff: match place {
            Place::Local(_) => falloff[random.below(4) as usize],
            Place::Infinite(_) => Falloff::None,
        },
        diffuse: [random.share(), random.share(), random.share()],
        specular: [random.share(), random.share(), random.share()].map(|c| c * 0.1),
    });
    let mut lighting = Lighting::new(&Material::default(), [0.0; 3], &[], DVec3::Z);
    lighting.lights = lights.collect();
    lighting.view = eye;
    let places = [
        [0.0, 0.0],
        [48.0, 48.0 * f64::from(random.share())],
        [3.0, 48.0],
    ];
    let weights = match random.below(2) {
        0 => [1.0; 3],
        _ => change.to_array().map(|c| (0.75 + c) as f32),
    };
    lighting.shininess = [1.0, 2.0, 8.0][random.below(3) as usize];
    lighting.specular = [SpecularModel::Phong, SpecularModel::Blinn][random.below(2) as usize];
    Triangle {
        places,
        weights,
        normals,
        points,
        lighting,
    }
}

/// Random triangles are as close to Phong's picture as stated, and somewhere not much closer. If
/// lights or eye are near, Duff's method follows them. To try more triangles:
///
/// ```text
/// FASTPHONG_TRIANGLES=60000 cargo test --release --test conformance -- random_triangles --nocapture
/// ```
#[test]
fn random_triangles_are_within_their_bounds() {
    let mut random = Random::new(9);
    let count = asked("FASTPHONG_TRIANGLES", 2000);
    for name in ["six-point", "six-point:midpoints=barrera", "bishop-weimer"] {
        let variant = Variant::parse(name).expect("a method");
        let (mut worst, mut kinds) = ((0.0f64, 0.0), [0; 2]);
        for number in 0..count {
            let triangle = random_triangle(&mut random);
            let frame = triangle.frame();
            for (sum, kind) in kinds.iter_mut().zip(variant.polygon_kinds(&frame)) {
                *sum += kind.polygons;
            }
            let truth = reference::render(&frame, Model::Phong).to_linear();
            // Where L·N is 0 up to rounding, rounding decides if there is a highlight.
            let is_clear = |x: usize, y: usize| {
                let place = [x, y].map(|at| at as f64 + 0.5);
                let products = triangle.products(triangle.barycentric(place));
                products[1..].chunks(3).all(|light| light[0].abs() > 1e-5)
            };
            let ours = variant
                .render_linear(&frame)
                .expect("a method for the frame");
            let (error, _) = largest_difference(&truth, &ours, is_clear);
            let bound = variant.bound(&frame);
            assert!(
                error <= bound,
                "{name}, triangle {number}: {error} over {bound}"
            );
            if variant.approximation(&frame) > 0.0 && bound < 1.0 && error / bound > worst.0 {
                worst = (error / bound, bound);
            }
        }
        println!("{name}: worst share {worst:?}, kinds {kinds:?}");
        assert!(kinds.iter().all(|kind| *kind > 100), "{name}: {kinds:?}");
        assert!(worst.0 > 0.25, "{name}: {worst:?}");
    }
}
