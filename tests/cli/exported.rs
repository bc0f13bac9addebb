//! The files of an export, and checks that they agree with one another and with the picture.

use super::Folder;
use super::redrawn::{self, Corner, Face, Numbers, Vector, dot, plus, times, unit, vector};
use fastphong::picture::image_file::read_picture;

/// Numbers have seven digits: they are off by 5·10⁻⁷ of their size, and vectors of three by less
/// than this.
const DIGITS: f64 = 1e-6;

/// Checks two vectors. `times` says how many vectors with rounded numbers went into one of them, or
/// more.
#[track_caller]
fn close(at: &str, found: Vector, expected: Vector, times: f64) {
    let error = plus(found, expected, -1.0);
    let size = dot(expected, expected).sqrt().max(1.0);
    let is_close = dot(error, error).sqrt() <= times * DIGITS * size;
    assert!(is_close, "{at}: {found:?}, not {expected:?}");
}

/// A row of `points.csv`: the names of its cells, and their texts.
struct Point(Vec<(String, String)>);

impl Point {
    fn cell(&self, key: &str) -> &str {
        let found = self.0.iter().find(|(name, _)| name == key);
        &found.unwrap_or_else(|| panic!("no {key}")).1
    }

    fn number(&self, key: &str) -> f64 {
        self.cell(key).parse().expect("a number")
    }

    fn pixel(&self) -> [usize; 2] {
        ["column", "row"].map(|key| self.number(key) as usize)
    }

    fn vector(&self, key: &str) -> Vector {
        ["x", "y", "z"].map(|end| self.number(&format!("{key}_{end}")))
    }

    fn colour(&self, key: &str) -> Vector {
        ["r", "g", "b"].map(|end| self.number(&format!("{key}_{end}")))
    }
}

/// A scene as its files tell it.
pub struct Exported {
    pub folder: Folder,
    pub numbers: Numbers,
    faces: Vec<Face>,
}

impl Exported {
    /// Exports `arguments`, which begin with the input, into the folder `out` of `folder`.
    pub fn new(folder: Folder, arguments: &str) -> Exported {
        folder.run(&format!("export {arguments} -o out")).done();
        let text = |name: &str| {
            String::from_utf8(folder.read(&format!("out/{name}"))).expect("text in UTF-8")
        };
        let numbers = Numbers(serde_json::from_str(&text("scene.json")).expect("JSON"));
        let faces = redrawn::faces(&text("mesh.obj"), &numbers);
        Exported {
            folder,
            numbers,
            faces,
        }
    }

    pub fn expected(&self) -> Vec<[u8; 3]> {
        let path = self.folder.path("out/expected.png");
        let file = read_picture(&path).expect("a picture");
        // Other programs state no encoding, and fill the background.
        assert_eq!(file.encoding, None);
        let expected = file.to_stored();
        assert!(expected.pixels().iter().all(|pixel| pixel[3] == 255));
        assert_eq!([expected.width(), expected.height()], self.numbers.size());
        let pixels = expected.pixels().iter();
        pixels.map(|&[r, g, b, _]| [r, g, b]).collect()
    }

    /// Draws the picture again, and checks it.
    ///
    /// The reference rounds corners to 1/256 pixel, which moves an edge by up to √2/512 pixel. So a
    /// pixel may show another face, or none, if its centre is within 0.0028 pixels of an edge. Such
    /// a pixel lies beside one that shows another face, and 1 in 180 of those is that near to an
    /// edge. All other pixels show one face in both pictures, and a colour moves by less than a
    /// level unless it changes by 350 levels from pixel to pixel. Normals, coefficients and
    /// directions are `f32` in the reference, which moves a colour by 2⁻²⁴ of its value times the
    /// exponent: less than 0.01 levels up to an exponent of 600. So levels differ by at most one,
    /// where a value is close to the middle between two.
    fn check_picture(&self, name: &str) {
        let (ours, expected) = (redrawn::draw(&self.numbers, &self.faces), self.expected());
        let [width, height] = self.numbers.size();
        let (mut beside, mut changed, mut covered) = (0, 0, 0);
        for (at, expected) in expected.iter().enumerate() {
            let (x, y) = (at % width, at / width);
            let columns = x.saturating_sub(1)..(x + 2).min(width);
            let rows = y.saturating_sub(1)..(y + 2).min(height);
            let is_beside = rows
                .flat_map(|y| columns.clone().map(move |x| y * width + x))
                .any(|other| ours.faces[other] != ours.faces[at]);
            let levels = ours.levels[at];
            let is_same = (0..3).all(|c| levels[c].abs_diff(expected[c]) <= 1);
            assert!(
                is_same || is_beside,
                "{name}: column {x}, row {y}: {levels:?}, not {expected:?}"
            );
            covered += usize::from(ours.faces[at].is_some());
            beside += usize::from(is_beside);
            changed += usize::from(!is_same);
        }
        assert!(changed <= 3 + beside / 100, "{name}: {changed} of {beside}");
        assert!(covered > width * height / 50, "{name}: {covered} covered");
    }

    /// Returns the rows of `points.csv`.
    fn points(&self) -> Vec<Point> {
        let text = String::from_utf8(self.folder.read("out/points.csv")).expect("text");
        let mut lines = text.lines();
        let head: Vec<&str> = lines.next().expect("a head").split(',').collect();
        let point = |line: &str| {
            let cells: Vec<&str> = line.split(',').collect();
            assert_eq!(cells.len(), head.len(), "{line}");
            let pairs = head.iter().zip(cells);
            Point(pairs.map(|(a, b)| (String::from(*a), b.into())).collect())
        };
        lines.map(point).collect()
    }

    /// Checks each row of `points.csv` by the other files.
    fn check_points(&self, name: &str) {
        let expected = self.expected();
        let points = self.points();
        let mut pixels: Vec<[usize; 2]> = points.iter().map(Point::pixel).collect();
        assert!(pixels.is_sorted_by_key(|[x, y]| [*y, *x]), "{name}");
        pixels.dedup();
        assert!((1..=10).contains(&pixels.len()), "{name}");
        for point in &points {
            let [x, y] = point.pixel();
            let at = format!("{name}: column {x}, row {y}");
            let face = &self.faces[point.number("face") as usize];
            self.check_vectors(&at, point);
            self.check_corners(&at, face, point);
            self.check_light(&at, face, point);
            let mut sum = point.colour("ambient");
            for other in points.iter().filter(|other| other.pixel() == [x, y]) {
                sum = plus(sum, other.colour("diffuse"), 1.0);
                sum = plus(sum, other.colour("specular"), 1.0);
            }
            close(&at, point.colour("sum"), sum, 16.0);
            let levels = point.colour("level");
            let stored = expected[y * self.numbers.size()[0] + x].map(f64::from);
            assert_eq!(levels, stored, "{at}");
            for (level, c) in levels.into_iter().zip(point.colour("sum")) {
                // Half a level of rounding, and the reference's `f32`.
                let exact = self.numbers.level(c);
                assert!((level - exact).abs() <= 0.51, "{at}: {level}, not {exact}");
            }
        }
    }

    fn in_view(&self, v: Vector, w: f64) -> Vector {
        let [x, y, z, _] = times(&self.numbers.matrix("view"), [v[0], v[1], v[2], w]);
        [x, y, z]
    }

    fn check_vectors(&self, at: &str, point: &Point) {
        let [p, n, v] = ["P", "N", "V"].map(|key| point.vector(key));
        close(at, point.vector("P_view"), self.in_view(p, 1.0), 1.0);
        close(at, point.vector("N_view"), self.in_view(n, 0.0), 2.0);
        close(at, point.vector("V_view"), self.in_view(v, 0.0), 2.0);
        close(at, v, redrawn::to_eye(&self.numbers, p), 2.0);
        close(at, [dot(n, n), 0.0, 0.0], [1.0, 0.0, 0.0], 2.0);
    }

    /// Checks the terms of a row. R comes from N twice and from L, and its cosine from V, too.
    fn check_light(&self, at: &str, face: &Face, point: &Point) {
        let material = &self.numbers.table("materials")[face.material];
        assert_eq!(material["name"], point.cell("material"), "{at}");
        let (i_a, ka) = (self.numbers.vector("ambient"), vector(&material["ka"]));
        let ambient = point.colour("ambient");
        let here = Corner {
            position: point.vector("P"),
            normal: point.vector("N"),
            // The ambient term is the only one that shows the vertex colour.
            colour: [0, 1, 2].map(|i| match i_a[i] * ka[i] {
                0.0 => 1.0,
                whole => ambient[i] / whole,
            }),
        };
        let (_, lights) = redrawn::light(&self.numbers, face.material, &here);
        let Ok(index) = point.cell("light").parse::<usize>() else {
            return assert!(lights.is_empty(), "{at}");
        };
        let light = &lights[index];
        let [r, cosine] = if self.numbers.flag("blinn") {
            ["H", "N.H"]
        } else {
            ["R", "R.V"]
        };
        close(at, point.vector("L"), light.l, 2.0);
        close(at, point.vector("L_view"), self.in_view(light.l, 0.0), 4.0);
        close(at, point.vector(r), light.r, 8.0);
        let cosines = [point.number("L.N"), point.number(cosine), 0.0];
        close(at, cosines, [light.l_n, light.cosine, 0.0], 8.0);
        close(at, point.colour("diffuse"), light.diffuse, 16.0);
        // A power multiplies the relative error of its base by the exponent.
        let exponent = material["n"].as_f64().expect("n").max(1.0);
        close(
            at,
            point.colour("specular"),
            light.specular,
            16.0 * exponent,
        );
    }

    /// Checks position and normal of a point by the corners of its triangle. The reference's
    /// corners are off by up to √2/512 pixel, so weights are off by that over the triangle's
    /// height.
    fn check_corners(&self, at: &str, face: &Face, point: &Point) {
        let [p, n] = ["P", "N"].map(|key| point.vector(key));
        let to_pixel = self.numbers.matrix("world_to_pixel");
        let on_picture = |corner: &Corner| {
            let [x, y, z] = corner.position;
            let [x, y, _, w] = times(&to_pixel, [x, y, z, 1.0]);
            ([x / w, y / w], w)
        };
        let [a, b, c] = face.corners[..] else {
            return;
        };
        let seen = [a, b, c].map(|corner| on_picture(&corner));
        if seen.iter().any(|(_, w)| *w <= 0.0) {
            return;
        }
        let cross = |p: [f64; 2], q: [f64; 2], r: [f64; 2]| {
            (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])
        };
        let corners = seen.map(|(place, _)| place);
        let centre = point.pixel().map(|c| c as f64 + 0.5);
        let weight = |i: usize| {
            let mut moved = corners;
            moved[i] = centre;
            cross(moved[0], moved[1], moved[2]) / cross(corners[0], corners[1], corners[2])
        };
        let is_correct = self.numbers.flag("perspective_correct");
        let inv_w = |i: usize| if is_correct { 1.0 / seen[i].1 } else { 1.0 };
        let weights = [0, 1, 2].map(|i| weight(i) * inv_w(i));
        let whole: f64 = weights.iter().sum();
        let value = |of: fn(&Corner) -> Vector| {
            let corners = [a, b, c];
            (0..3).fold([0.0; 3], |sum, i| {
                plus(sum, of(&corners[i]), weights[i] / whole)
            })
        };
        let side = |i: usize| {
            let [p, q] = [corners[i], corners[(i + 1) % 3]];
            (p[0] - q[0]).hypot(p[1] - q[1])
        };
        let longest = (0..3).map(side).fold(0.0, f64::max);
        let height = cross(corners[0], corners[1], corners[2]).abs() / longest;
        // Two corners may move in opposite directions.
        let by = 2.0 * 0.0028 / height;
        let spread = |of: fn(&Corner) -> Vector| {
            let apart = |a: &Corner, b: &Corner| {
                let step = plus(of(a), of(b), -1.0);
                dot(step, step).sqrt()
            };
            apart(&a, &b) + apart(&b, &c)
        };
        let mut normal = unit(value(|corner| corner.normal));
        if self.numbers.flag("two_sided") && dot(normal, n) < 0.0 {
            normal = normal.map(|c| -c);
        }
        for (found, expected, of) in [
            (
                p,
                value(|corner| corner.position),
                (|c: &Corner| c.position) as fn(&Corner) -> Vector,
            ),
            (n, normal, |c: &Corner| c.normal),
        ] {
            let error = plus(found, expected, -1.0);
            let size = dot(expected, expected).sqrt();
            // Interpolated normals are shorter than 1, but not half as long.
            let most = 2.0 * by * spread(of) + 1e-6 * size.max(1.0);
            assert!(
                dot(error, error).sqrt() <= most,
                "{at}: {found:?}, not {expected:?}"
            );
        }
    }

    /// Checks that matrices, camera and lights say one thing. They are rounded a few times in
    /// `f64`, and camera and planes may be 10⁶ times as far away as they are apart.
    fn check_camera(&self, name: &str) {
        let numbers = &self.numbers;
        let [view, projection] = ["view", "projection"].map(|key| numbers.matrix(key));
        let number = |key: &str| numbers.0[key].as_f64();
        let close = |key: &str, found: f64, expected: f64| {
            let most = 1e-9 * expected.abs().max(1.0);
            assert!(
                (found - expected).abs() <= most,
                "{name}: {key}: {found}, not {expected}"
            );
        };
        let in_view = |v: Vector, w: f64| times(&view, [v[0], v[1], v[2], w]);
        let (eye, target) = (numbers.vector("eye"), numbers.vector("target"));
        let line = plus(eye, target, -1.0);
        let [x, y, z, _] = in_view(target, 1.0);
        for (found, expected) in [x, y, z]
            .into_iter()
            .zip([0.0, 0.0, -dot(line, line).sqrt()])
        {
            close("target", found, expected);
        }
        in_view(eye, 1.0)[..3]
            .iter()
            .for_each(|c| close("eye", *c, 0.0));
        close("up", in_view(numbers.vector("up"), 0.0)[0], 0.0);
        assert!(in_view(numbers.vector("up"), 0.0)[1] > 0.0, "{name}");
        for (key, expected) in [("near", -1.0), ("far", 1.0)] {
            let plane = number(key).expect("a distance");
            let [_, _, z, w] = times(&projection, [0.0, 0.0, -plane, 1.0]);
            close(key, z / w, expected);
        }
        let scale = match (number("fovy"), number("half_height")) {
            (Some(fovy), None) => 1.0 / (fovy.to_radians() / 2.0).tan(),
            (None, Some(half)) => 1.0 / half,
            other => panic!("{name}: {other:?}"),
        };
        assert_eq!(numbers.flag("perspective"), number("fovy").is_some());
        close("scale", projection[1][1], scale);
        for light in numbers.table("lights") {
            let (key, w) = if light["positional"] == true {
                ("position", 1.0)
            } else {
                ("direction", 0.0)
            };
            let world = vector(&light[key]);
            let seen = vector(&light[&*format!("{key}_view")]);
            let expected = in_view(world, w);
            (0..3).for_each(|i| close(key, seen[i], expected[i]));
            if w == 0.0 {
                close("length", dot(world, world), 1.0);
            }
        }
    }

    pub fn check(&self, name: &str) {
        self.check_camera(name);
        self.check_picture(name);
        self.check_points(name);
    }
}
