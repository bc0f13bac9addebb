//! A renderer that knows a scene only from the files of `fastphong export`, as another program
//! does. It shares no code with the engines or the reference, and computes in `f64`.

use serde_json::Value;

pub type Vector = [f64; 3];
type Matrix = [[f64; 4]; 4];

pub fn dot(a: Vector, b: Vector) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

pub fn plus(a: Vector, b: Vector, factor: f64) -> Vector {
    [0, 1, 2].map(|i| a[i] + factor * b[i])
}

pub fn unit(a: Vector) -> Vector {
    let length = dot(a, a).sqrt();
    a.map(|c| c / length)
}

/// Returns the product of a row-major matrix and a column.
pub fn times(matrix: &Matrix, p: [f64; 4]) -> [f64; 4] {
    matrix.map(|row| row.iter().zip(p).map(|(a, b)| a * b).sum())
}

/// `scene.json`.
pub struct Numbers(pub Value);

impl Numbers {
    pub fn flag(&self, key: &str) -> bool {
        self.0[key].as_bool().unwrap_or_else(|| panic!("{key}"))
    }

    pub fn word(&self, key: &str) -> &str {
        self.0[key].as_str().unwrap_or_else(|| panic!("{key}"))
    }

    pub fn size(&self) -> [usize; 2] {
        ["width", "height"].map(|key| self.0[key].as_u64().expect("a side") as usize)
    }

    pub fn vector(&self, key: &str) -> Vector {
        vector(&self.0[key])
    }

    pub fn matrix(&self, key: &str) -> Matrix {
        let entry = |i: usize, k: usize| self.0[key][i][k].as_f64().expect("a matrix");
        [0, 1, 2, 3].map(|i| [0, 1, 2, 3].map(|k| entry(i, k)))
    }

    pub fn table(&self, key: &str) -> &[Value] {
        self.0[key].as_array().unwrap_or_else(|| panic!("{key}"))
    }

    /// Returns a colour as a level, before it is rounded.
    pub fn level(&self, c: f64) -> f64 {
        let c = c.clamp(0.0, 1.0);
        let encoded = if !self.flag("srgb") {
            c
        } else if c > 0.003_130_8 {
            1.055 * c.powf(1.0 / 2.4) - 0.055
        } else {
            12.92 * c
        };
        255.0 * encoded
    }
}

pub fn vector(value: &Value) -> Vector {
    [0, 1, 2].map(|i| value[i].as_f64().unwrap_or_else(|| panic!("{value}")))
}

/// A corner: position, normal, and the colour of its vertex.
#[derive(Clone, Copy)]
pub struct Corner {
    pub position: Vector,
    pub normal: Vector,
    pub colour: Vector,
}

pub struct Face {
    pub corners: Vec<Corner>,
    pub material: usize,
}

/// Reads `mesh.obj` the way simple loaders do.
pub fn faces(obj: &str, numbers: &Numbers) -> Vec<Face> {
    let (mut v, mut vn, mut faces) = (Vec::new(), Vec::new(), Vec::new());
    let (mut texture, mut material) = (0, None);
    for line in obj.lines() {
        let mut words = line.split(' ');
        let kind = words.next();
        let three = |words: &[&str]| [0, 1, 2].map(|i| words[i].parse().expect("a number"));
        let words: Vec<&str> = words.collect();
        match kind {
            Some("v") => v.push((
                three(&words),
                words.get(3..6).map(three).unwrap_or([1.0; 3]),
            )),
            Some("vn") => vn.push(three(&words)),
            Some("vt") => texture += 1,
            Some("usemtl") => {
                let mut all = numbers.table("materials").iter();
                material = all.position(|material| material["name"] == words[0]);
            }
            Some("f") => {
                let corner = |word: &&str| {
                    let index = |text: &str| text.parse::<usize>().expect("an index") - 1;
                    let [at, vt, n] = word.split('/').collect::<Vec<_>>()[..] else {
                        panic!("not v/vt/vn: {word}")
                    };
                    assert!(index(vt) < texture, "{word}");
                    let (position, colour) = v[index(at)];
                    let normal: Vector = vn[index(n)];
                    assert!((dot(normal, normal) - 1.0).abs() < 1e-6, "{normal:?}");
                    Corner {
                        position,
                        normal,
                        colour,
                    }
                };
                faces.push(Face {
                    corners: words.iter().map(corner).collect(),
                    material: material.expect("a material"),
                });
            }
            _ => assert!(
                line.starts_with(['#', 'o', 'm']) || line.is_empty(),
                "{line}"
            ),
        }
    }
    faces
}

/// The light at a point, with the vectors on the way.
pub struct Light {
    pub l: Vector,
    pub r: Vector,
    pub l_n: f64,
    pub cosine: f64,
    pub diffuse: Vector,
    pub specular: Vector,
}

/// Returns V.
pub fn to_eye(numbers: &Numbers, p: Vector) -> Vector {
    if numbers.flag("local_viewer") {
        unit(plus(numbers.vector("eye"), p, -1.0))
    } else {
        numbers.vector("to_eye")
    }
}

/// Returns the ambient term and the light of each source.
pub fn light(numbers: &Numbers, material: usize, at: &Corner) -> (Vector, Vec<Light>) {
    let material = &numbers.table("materials")[material];
    let coefficient = |key: &str| vector(&material[key]);
    let (p, n, c) = (at.position, at.normal, at.colour);
    let v = to_eye(numbers, p);
    let (i_a, ka) = (numbers.vector("ambient"), coefficient("ka"));
    let ambient = [0, 1, 2].map(|i| i_a[i] * ka[i] * c[i]);
    let of_light = |light: &Value| {
        let (l, strength) = if light["positional"] == true {
            let to_light = plus(vector(&light["position"]), p, -1.0);
            let r = dot(to_light, to_light).sqrt();
            let k = light["attenuation"].as_f64().expect("k");
            let strength = match light["falloff"].as_str() {
                Some("none") => 1.0,
                Some("attenuation") => 1.0 / (1.0 + k * r * r),
                Some("inverse-square") => 1.0 / (r * r),
                Some("inverse") => 1.0 / r,
                other => panic!("{other:?}"),
            };
            (unit(to_light), strength)
        } else {
            (vector(&light["direction"]), 1.0)
        };
        let l_n = dot(l, n);
        let (r, cosine) = if numbers.flag("blinn") {
            let h = unit(plus(l, v, 1.0));
            (h, dot(n, h))
        } else {
            let r = plus(n.map(|c| 2.0 * l_n * c), l, -1.0);
            (r, dot(r, v))
        };
        let gate = match numbers.word("gate") {
            "ungated" => 1.0,
            "weighted" => l_n.max(0.0),
            _ if l_n > 0.0 => 1.0,
            _ => 0.0,
        };
        let power = cosine.max(0.0).powf(material["n"].as_f64().expect("n"));
        let colour = vector(&light["colour"]).map(|c| c * strength);
        let (kd, ks) = (coefficient("kd"), coefficient("ks"));
        Light {
            l,
            r,
            l_n,
            cosine,
            diffuse: [0, 1, 2].map(|i| colour[i] * kd[i] * c[i] * l_n.max(0.0)),
            specular: [0, 1, 2].map(|i| colour[i] * ks[i] * gate * power),
        }
    };
    let lights = numbers.table("lights").iter().map(of_light).collect();
    (ambient, lights)
}

/// Returns the sum of all terms.
pub fn colour(numbers: &Numbers, material: usize, at: &Corner) -> Vector {
    let (ambient, lights) = light(numbers, material, at);
    lights.iter().fold(ambient, |sum, light| {
        plus(plus(sum, light.diffuse, 1.0), light.specular, 1.0)
    })
}

/// A vertex in clip space with its values: position, normal, colour.
#[derive(Clone, Copy)]
struct Vertex {
    clip: [f64; 4],
    values: [f64; 9],
}

fn between(a: f64, b: f64, t: f64) -> f64 {
    a + (b - a) * t
}

/// Cuts a polygon where `inside`, a linear function of clip space, is 0.
fn cut(polygon: &[Vertex], inside: fn([f64; 4]) -> f64) -> Vec<Vertex> {
    let mut out = Vec::new();
    for (i, a) in polygon.iter().enumerate() {
        let b = &polygon[(i + 1) % polygon.len()];
        let (from, to) = (inside(a.clip), inside(b.clip));
        if from >= 0.0 {
            out.push(*a);
        }
        if (from >= 0.0) != (to >= 0.0) {
            let t = from / (from - to);
            out.push(Vertex {
                clip: [0, 1, 2, 3].map(|k| between(a.clip[k], b.clip[k], t)),
                values: std::array::from_fn(|k| between(a.values[k], b.values[k], t)),
            });
        }
    }
    out
}

/// The picture, and the face at each pixel.
pub struct Picture {
    pub levels: Vec<[u8; 3]>,
    pub faces: Vec<Option<usize>>,
}

/// A corner on the picture: pixels and depth, w, and values.
#[derive(Clone, Copy)]
struct Seen {
    place: [f64; 4],
    w: f64,
    values: [f64; 9],
}

/// A point of a triangle at the centre of a pixel.
struct Fragment<'a> {
    pixel: usize,
    triangle: &'a [Seen; 3],
    weights: [f64; 3],
    /// True if the corners run clockwise.
    is_back: bool,
}

impl Fragment<'_> {
    fn depth(&self, numbers: &Numbers) -> f64 {
        let corners = self.triangle.iter().zip(self.weights);
        let depth: f64 = corners
            .map(|(corner, weight)| weight * corner.place[2])
            .sum();
        match numbers.0["depth_bits"].as_u64().expect("bits") {
            32 => depth,
            bits => (depth * ((1u64 << bits) - 1) as f64).round(),
        }
    }

    fn surface(&self, numbers: &Numbers) -> Corner {
        let is_correct = numbers.flag("perspective_correct");
        let weight = |i: usize| {
            let inv_w = if is_correct {
                1.0 / self.triangle[i].w
            } else {
                1.0
            };
            self.weights[i] * inv_w
        };
        let weights = [0, 1, 2].map(weight);
        let whole: f64 = weights.iter().sum();
        let value = |k: usize| {
            let corners = self.triangle.iter().zip(weights);
            let sum: f64 = corners
                .map(|(corner, weight)| weight * corner.values[k])
                .sum();
            sum / whole
        };
        let three = |k: usize| [value(k), value(k + 1), value(k + 2)];
        let is_turned = self.is_back && numbers.flag("two_sided");
        let side = if is_turned { -1.0 } else { 1.0 };
        Corner {
            position: three(0),
            normal: unit(three(3)).map(|c| side * c),
            colour: three(6),
        }
    }
}

/// Returns the corners of a face on the picture, after it was cut at the near and the far plane.
fn seen(numbers: &Numbers, face: &Face) -> Vec<Seen> {
    let (view, projection) = (numbers.matrix("view"), numbers.matrix("projection"));
    let viewport = numbers.matrix("viewport");
    let vertex = |corner: &Corner| {
        let [x, y, z] = corner.position;
        let values = [corner.position, corner.normal, corner.colour].concat();
        Vertex {
            clip: times(&projection, times(&view, [x, y, z, 1.0])),
            values: values.try_into().expect("nine values"),
        }
    };
    let polygon: Vec<Vertex> = face.corners.iter().map(vertex).collect();
    let polygon = cut(&polygon, |[_, _, z, w]| z + w);
    let polygon = cut(&polygon, |[_, _, z, w]| w - z);
    let on_picture = |vertex: &Vertex| {
        let w = vertex.clip[3];
        Seen {
            place: times(&viewport, vertex.clip.map(|c| c / w)),
            w,
            values: vertex.values,
        }
    };
    polygon.iter().map(on_picture).collect()
}

/// Draws all faces in Phong shading.
pub fn draw(numbers: &Numbers, faces: &[Face]) -> Picture {
    let size = numbers.size();
    let [width, height] = size;
    let level = |c: f64| numbers.level(c).round() as u8;
    let mut picture = Picture {
        levels: vec![numbers.vector("background").map(level); width * height],
        faces: vec![None; width * height],
    };
    let mut depths = vec![f64::INFINITY; width * height];
    let (culling, visibility) = (numbers.word("culling"), numbers.word("visibility"));
    for (index, face) in faces.iter().enumerate() {
        let corners = seen(numbers, face);
        for i in 2..corners.len() {
            fill(
                &[corners[0], corners[i - 1], corners[i]],
                size,
                |fragment| {
                    let culled = if fragment.is_back { "back" } else { "front" };
                    let (at, depth) = (fragment.pixel, fragment.depth(numbers));
                    let is_hidden = visibility == "z-buffer" && depth >= depths[at];
                    if culling != culled && !is_hidden {
                        depths[at] = depth;
                        let here = fragment.surface(numbers);
                        picture.levels[at] = colour(numbers, face.material, &here).map(level);
                        picture.faces[at] = Some(index);
                    }
                },
            );
        }
    }
    picture
}

/// Calls `put` for each pixel whose centre is in a triangle.
fn fill(triangle: &[Seen; 3], [width, height]: [usize; 2], mut put: impl FnMut(Fragment<'_>)) {
    let [a, b, c] = triangle.map(|corner| [corner.place[0], corner.place[1]]);
    let cross = |p: [f64; 2], q: [f64; 2], r: [f64; 2]| {
        (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])
    };
    // Rows count downward, so corners that run clockwise have a positive area.
    let area = cross(a, b, c);
    if area == 0.0 {
        return;
    }
    let pixels = |axis: usize, side: usize| {
        let all = [a, b, c].map(|p| p[axis]);
        let low = all.into_iter().fold(f64::INFINITY, f64::min);
        let high = all.into_iter().fold(f64::NEG_INFINITY, f64::max);
        (low - 0.5).ceil().max(0.0) as usize..((high + 0.5).max(0.0) as usize).min(side)
    };
    for y in pixels(1, height) {
        for x in pixels(0, width) {
            let p = [x as f64 + 0.5, y as f64 + 0.5];
            let weights = [cross(p, b, c), cross(a, p, c), cross(a, b, p)].map(|w| w / area);
            if weights.iter().all(|weight| *weight >= 0.0) {
                put(Fragment {
                    pixel: y * width + x,
                    triangle,
                    weights,
                    is_back: area > 0.0,
                });
            }
        }
    }
}
