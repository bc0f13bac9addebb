//! The light, the material, spans and globes. All are in integers, so that they are equal on every
//! machine.

use fastphong::fixed::types::{I17F15, I24F8, U16F16};
use fastphong::integer::{Light, Material, Pixel, Span, Vector, Vertex, unit};

const fn colour(red: &str, green: &str, blue: &str) -> [U16F16; 3] {
    [U16F16::lit(red), U16F16::lit(green), U16F16::lit(blue)]
}
/// Clay with a white highlight of shininess 32.
pub const fn clay<P: Pixel>() -> Material<P> {
    let (ambient, diffuse) = (colour("0.1", "0.06", "0.04"), colour("0.5", "0.3", "0.2"));
    Material::new(ambient, diffuse, colour("0.4", "0.4", "0.4"), 32)
}
/// What further lights add to the first one.
pub const fn more<P: Pixel>() -> Material<P> {
    let none = colour("0", "0", "0");
    Material::new(
        none,
        colour("0.1", "0.15", "0.3"),
        colour("0.2", "0.2", "0.2"),
        32,
    )
}

pub const EYE: [i16; 3] = [0, 0, 1];
pub const TOWARD: [i16; 3] = [2, 3, 6];

/// Returns four lights. Figures with one light use the first.
pub fn lights<'a, P: Pixel>(first: &'a Material<P>, more: &'a Material<P>) -> [Light<'a, P>; 4] {
    let eye = unit(EYE);
    [
        Light::new(unit(TOWARD), eye, first),
        Light::new(unit([-6, 2, 3]), eye, more),
        Light::new(unit([1, -8, 4]), eye, more),
        Light::new(unit([-4, -4, 7]), eye, more),
    ]
}

/// The angles between the normals of a span in degrees, with cosine and sine of half the angle,
/// times 2¹⁴.
pub const ANGLES: [(u32, i32, i32); 4] = [
    (5, 16368, 715),
    (15, 16244, 2139),
    (30, 15826, 4240),
    (60, 14189, 8192),
];

/// A fixed sequence of pseudo-random values from −2¹² to 2¹².
pub struct Random(pub u32);

impl Random {
    fn next(&mut self) -> i32 {
        self.0 = self.0.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (self.0 >> 19) as i32 - 4096
    }

    /// Returns a vector of arbitrary bits, which is mostly longer than 1.
    pub fn vector(&mut self) -> Vector {
        let shift = self.next() & 15;
        Vector::new([0; 3].map(|_| I17F15::from_bits(self.next() << shift)))
    }

    /// Returns a span of an angle, and its normals. A bright span passes near the highlight.
    pub fn span(&mut self, (_, cos, sin): (u32, i32, i32), is_bright: bool) -> (Span, [Vector; 2]) {
        let middle = if is_bright {
            // Halfway between light and eye is (2, 3, 13).
            [
                2 * 300 + (self.next() >> 4),
                3 * 300 + (self.next() >> 4),
                13 * 300,
            ]
        } else {
            [self.next(), self.next(), self.next().abs() + 2000]
        };
        let m = bits(unit(middle.map(|x| x as i16)));
        let u = [self.next(), self.next(), self.next() | 1];
        let product = [
            (m[1] * u[2] - m[2] * u[1]) >> 14,
            (m[2] * u[0] - m[0] * u[2]) >> 14,
            (m[0] * u[1] - m[1] * u[0]) >> 14,
        ];
        let across = bits(unit(product.map(|x| x as i16)));
        let end = |sign: i32| {
            let one = |i: usize| ((m[i] * cos + sign * across[i] * sin) >> 16) as i16;
            unit([one(0), one(1), one(2)])
        };
        let ends = [end(-1), end(1)];
        (Span::new(ends[0], ends[1]), ends)
    }
}

fn bits(v: Vector) -> [i32; 3] {
    v.to_array().map(|x| x.to_bits())
}

/// The side of frames in pixels.
pub const SIDE: usize = 240;

/// The most vertices of a globe, which has at most 48 columns and 32 rows.
const MOST: usize = 48 * 31 + 2;

/// A globe that fills a frame: its vertices, and the corners of the triangles that face the eye.
pub struct Globe {
    pub vertices: [Vertex; MOST],
    pub corners: [[u16; 3]; 1488],
    pub count: usize,
}

impl Globe {
    pub const fn new() -> Self {
        let none = Vertex {
            x: I24F8::ZERO,
            y: I24F8::ZERO,
            depth: 0,
            normal: unit([0; 3]),
        };
        Self {
            vertices: [none; MOST],
            corners: [[0; 3]; 1488],
            count: 0,
        }
    }

    /// Makes a globe of `around` columns and `down` rows.
    pub fn make(&mut self, around: usize, down: usize) {
        let mut at = 0;
        let (tilt_sin, tilt_cos) = sine_cosine(4, 63);
        for j in 0..=down {
            let (down_sin, down_cos) = sine_cosine(j as i64, 2 * down as i64);
            let columns = if j == 0 || j == down { 1 } else { around };
            for i in 0..columns {
                let (sin, cos) = sine_cosine(i as i64, around as i64);
                let (x, y, z) = ((down_sin * cos) >> 28, down_cos, (down_sin * sin) >> 28);
                let y_tilted = (y * tilt_cos - z * tilt_sin) >> 28;
                let z_tilted = (y * tilt_sin + z * tilt_cos) >> 28;
                let normal = [x, y_tilted, z_tilted].map(|x| ((x + (1 << 13)) >> 14) as i16);
                if let Some(vertex) = self.vertices.get_mut(at) {
                    *vertex = Vertex {
                        x: I24F8::from_bits((120 * 256 + ((110 * 256 * x) >> 28)) as i32),
                        y: I24F8::from_bits((120 * 256 - ((110 * 256 * y_tilted) >> 28)) as i32),
                        depth: (32768 - ((30000 * z_tilted) >> 28)) as u16,
                        normal: unit(normal),
                    };
                }
                at += 1;
            }
        }
        // The index of a vertex. Each pole is a single vertex.
        let index = |i: usize, j: usize| match j {
            0 => 0,
            _ if j == down => 1 + around * (down - 1),
            _ => 1 + around * (j - 1) + if i == around { 0 } else { i },
        };
        self.count = 0;
        for j in 0..down {
            for i in 0..around {
                let quad = [
                    index(i, j),
                    index(i + 1, j),
                    index(i + 1, j + 1),
                    index(i, j + 1),
                ];
                self.add([quad[0], quad[2], quad[1]]);
                self.add([quad[0], quad[3], quad[2]]);
            }
        }
    }

    /// Adds a triangle if it faces the eye.
    fn add(&mut self, corners: [usize; 3]) {
        let Some([a, b, c]) = self.corners_of(corners.map(|i| i as u16)) else {
            return;
        };
        let side = |v: Vertex| {
            [
                i64::from((v.x - a.x).to_bits()),
                i64::from((v.y - a.y).to_bits()),
            ]
        };
        let (b, c) = (side(b), side(c));
        if b[0] * c[1] - c[0] * b[1] > 0
            && let Some(place) = self.corners.get_mut(self.count)
        {
            *place = corners.map(|i| i as u16);
            self.count += 1;
        }
    }

    /// Returns the corners of a triangle.
    #[inline(always)]
    pub fn corners_of(&self, [a, b, c]: [u16; 3]) -> Option<[Vertex; 3]> {
        let get = |i: u16| self.vertices.get(i as usize).copied();
        Some([get(a)?, get(b)?, get(c)?])
    }
}

/// Returns sine and cosine of `part`/`whole` of a turn, with 28 fractional bits.
fn sine_cosine(part: i64, whole: i64) -> (i64, i64) {
    // Reduce the angle to at most ⅛ turn from the nearest quarter.
    let eighths = (part * 8 / whole.max(1)) & 7;
    let quarter = (eighths + 1) >> 1;
    let rest = part * 4 - quarter * whole;
    // 2π with 28 fractional bits, over 4.
    let x = rest * 421_657_428 / whole.max(1);
    let square = (x * x) >> 28;
    let (mut sine, mut cosine) = (1 << 28, 1 << 28);
    for k in [13, 11, 9, 7, 5, 3] {
        sine = (1 << 28) - (((square * sine) >> 28) / (k * (k - 1)));
        cosine = (1 << 28) - (((square * cosine) >> 28) / ((k - 1) * (k - 2)));
    }
    sine = (sine * x) >> 28;
    match quarter & 3 {
        0 => (sine, cosine),
        1 => (cosine, -sine),
        2 => (-sine, -cosine),
        _ => (-cosine, sine),
    }
}
