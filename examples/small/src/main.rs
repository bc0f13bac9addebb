//! Shades spans and draws frames on a bare machine, and prints a checksum for each. `run` counts
//! its instructions.
#![cfg_attr(target_os = "none", no_std, no_main)]

mod machine;
mod scene;
#[cfg(feature = "soft")]
mod soft;

use fastphong::integer::{
    Canvas, Halfway, Light, Material, NoHighlight, Pixel, Reflection, Rgb565, Rgb565Be, Rgb888,
    Span, Vector, Vertex, colour, gouraud,
};
use machine::{Line, Memory, NOTHING, checksum, end, start_counting, stop_counting, write_count};
use scene::{ANGLES, Globe, Random, SIDE, clay, lights, more};

static CLAY: Material<Rgb565> = clay();
static CLAY_BE: Material<Rgb565Be> = clay();
static CLAY_888: Material<Rgb888> = clay();
static MORE: Material<Rgb565> = more();
static MORE_BE: Material<Rgb565Be> = more();
static MORE_888: Material<Rgb888> = more();

type Lights<P> = [Light<'static, P>; 4];
type Shade<P> = fn(Case, &mut [P], &Lights<P>);

/// A span, with the normals and colours of its ends.
#[derive(Clone, Copy)]
pub struct Case {
    span: Span,
    #[cfg_attr(not(feature = "soft"), expect(dead_code))]
    normals: [Vector; 2],
    colours: [u32; 2],
}

/// Lists methods, each with its name and its loop, which is compiled as a separate function.
macro_rules! methods {
    ($pixel:ty: $($name:literal $function:ident |$span:ident, $line:ident, $lights:ident| $body:expr;)*) => {{
        $(
            #[inline(never)]
            fn $function($span: Case, $line: &mut [$pixel], $lights: &Lights<$pixel>) {
                $body
            }
        )*
        [$(($name, $function as Shade<$pixel>)),*]
    }};
}

fn first<P: Pixel>(lights: &Lights<P>) -> &[Light<'static, P>; 1] {
    let [first, ..] = lights;
    core::array::from_ref(first)
}
fn two<P: Pixel>(lights: &Lights<P>) -> [Light<'static, P>; 2] {
    let [a, b, ..] = *lights;
    [a, b]
}

/// Shades spans of all lengths and angles by a method, and prints a line for each length and angle.
fn measure<P: Pixel>(
    name: &str,
    shade: Shade<P>,
    lights: &Lights<P>,
    blank: P,
    value: fn(P) -> u32,
) {
    let mut line = [blank; 128];
    for pixels in [8, 32, 128] {
        for angle in ANGLES {
            let mut random = Random(pixels ^ angle.0 << 8);
            let mut sum = NOTHING;
            for round in 0..16 {
                let (span, ends) = random.span(angle, round % 2 == 0);
                // Lighting the two vertices does not count as part of a span.
                let colours = ends.map(|n| colour::<_, Reflection, 1>(first(lights), n));
                let case = Case {
                    span,
                    normals: ends,
                    colours,
                };
                let Some(line) = line.get_mut(..pixels as usize) else {
                    continue;
                };
                start_counting();
                shade(case, line, lights);
                stop_counting();
                for pixel in line {
                    sum = checksum(sum, value(*pixel));
                }
            }
            write_count();
            let line = Line::new()
                .text("span ")
                .text(name)
                .text(" ")
                .number(pixels)
                .text(" ");
            line.number(angle.0).text(" ").number(sum).print();
        }
    }
}

/// Shades long lines between arbitrary vectors by a method, and prints a line of text for each
/// length. The lines are so long that spans are cut into pieces.
fn long_lines(name: &str, shade: Shade<Rgb565>, lights: &Lights<Rgb565>, memory: &mut [Rgb565]) {
    for pixels in [257, 1000, 57_600] {
        let mut random = Random(pixels);
        let mut sum = NOTHING;
        for _ in 0..2 {
            let normals = [random.vector(), random.vector()];
            let case = Case {
                span: Span::new(normals[0], normals[1]),
                normals,
                colours: normals.map(|n| colour::<_, Reflection, 1>(first(lights), n)),
            };
            let Some(line) = memory.get_mut(..pixels as usize) else {
                continue;
            };
            shade(case, line, lights);
            sum = line
                .iter()
                .fold(sum, |sum, pixel| checksum(sum, u32::from(pixel.0)));
        }
        write_count();
        let line = Line::new().text("long ").text(name).text(" ");
        line.number(pixels).text(" ").number(sum).print();
    }
}

static GLOBE: Memory<Globe> = Memory::new(Globe::new());
static FRAME: Memory<[Rgb565; SIDE * SIDE]> = Memory::new([Rgb565(0); SIDE * SIDE]);
static COLOURS: Memory<[u32; 1490]> = Memory::new([0; 1490]);

/// Draws frames of globes by each method.
fn frames(light: &[Light<'_, Rgb565>; 1], frame: &mut [Rgb565]) {
    let (Some(globe), Some(colours)) = (GLOBE.take(), COLOURS.take()) else {
        return;
    };
    type Draw = fn(&mut Canvas<'_, Rgb565>, &[Vertex; 3], &[Light<'_, Rgb565>; 1]) -> bool;
    let methods: [(&str, Draw); 5] = [
        ("naive", |canvas, t, l| {
            canvas.naive::<Reflection, false, 1>(t, l)
        }),
        ("naive-1", |canvas, t, l| {
            canvas.naive::<Reflection, true, 1>(t, l)
        }),
        ("fast", |canvas, t, l| {
            canvas.fast::<Reflection, false, 1>(t, l)
        }),
        ("fast-1", |canvas, t, l| {
            canvas.fast::<Reflection, true, 1>(t, l)
        }),
        ("quadratic", |canvas, t, l| {
            canvas.quadratic::<Reflection, 1>(t, l)
        }),
    ];
    for (around, down) in [(12, 8), (24, 16), (48, 32)] {
        globe.make(around, down);
        let Some(triangles) = globe.corners.get(..globe.count) else {
            continue;
        };
        let print = |name: &str, frame: &[Rgb565]| {
            write_count();
            let sum = frame
                .iter()
                .fold(NOTHING, |sum, pixel| checksum(sum, u32::from(pixel.0)));
            let pixels = frame.iter().filter(|pixel| pixel.0 != 0).count() as u32;
            let line = Line::new()
                .text("frame ")
                .text(name)
                .text(" ")
                .number(globe.count as u32)
                .text(" ")
                .number(pixels);
            line.text(" ").number(sum).print();
        };
        frame.fill(Rgb565(0));
        start_counting();
        // Each vertex is lit once.
        for (colour_of, vertex) in colours.iter_mut().zip(&globe.vertices) {
            *colour_of = colour::<_, Reflection, 1>(light, vertex.normal);
        }
        if let Some(mut canvas) = Canvas::new(frame, None, SIDE, SIDE) {
            for corners in triangles {
                let of = |i: u16| colours.get(i as usize).copied().unwrap_or(0);
                if let Some([a, b, c]) = globe.corners_of(*corners) {
                    let [i, j, k] = *corners;
                    canvas.gouraud(&[(a, of(i)), (b, of(j)), (c, of(k))]);
                }
            }
        }
        stop_counting();
        print("gouraud", frame);
        for (name, draw) in methods {
            frame.fill(Rgb565(0));
            start_counting();
            if let Some(mut canvas) = Canvas::new(frame, None, SIDE, SIDE) {
                for corners in triangles {
                    if let Some(t) = globe.corners_of(*corners) {
                        draw(&mut canvas, &t, light);
                    }
                }
            }
            stop_counting();
            print(name, frame);
        }
    }
}

fn all() {
    let Some(frame) = FRAME.take() else {
        return;
    };
    let rgb565 = lights(&CLAY, &MORE);
    let methods = methods! { Rgb565:
        "gouraud" gouraud_span |s, p, _l| {
            let [a, b] = s.colours;
            gouraud(p, a, b);
        };
        "naive-as-printed" naive_as_printed |s, p, l| s.span.naive_as_printed(p, &first(l)[0]);
        "naive" naive |s, p, l| s.span.naive::<_, Reflection, false, 1>(p, first(l));
        "naive-1" naive_1 |s, p, l| s.span.naive::<_, Reflection, true, 1>(p, first(l));
        "naive-nh" naive_nh |s, p, l| s.span.naive::<_, Halfway, false, 1>(p, first(l));
        "naive-dull" naive_dull |s, p, l| s.span.naive::<_, NoHighlight, false, 1>(p, first(l));
        "naive-2-lights" naive_2 |s, p, l| s.span.naive::<_, Reflection, false, 2>(p, &two(l));
        "naive-4-lights" naive_4 |s, p, l| s.span.naive::<_, Reflection, false, 4>(p, l);
        "fast-as-printed" fast_as_printed |s, p, l| s.span.fast_as_printed(p, &first(l)[0]);
        "fast" fast |s, p, l| s.span.fast::<_, Reflection, false, 1>(p, first(l));
        "fast-1" fast_1 |s, p, l| s.span.fast::<_, Reflection, true, 1>(p, first(l));
        "fast-nh" fast_nh |s, p, l| s.span.fast::<_, Halfway, false, 1>(p, first(l));
        "fast-dull" fast_dull |s, p, l| s.span.fast::<_, NoHighlight, false, 1>(p, first(l));
        "fast-2-lights" fast_2 |s, p, l| s.span.fast::<_, Reflection, false, 2>(p, &two(l));
        "fast-4-lights" fast_4 |s, p, l| s.span.fast::<_, Reflection, false, 4>(p, l);
        "quadratic" quadratic |s, p, l| s.span.quadratic::<_, Reflection, 1>(p, first(l));
        "quadratic-nh" quadratic_nh |s, p, l| s.span.quadratic::<_, Halfway, 1>(p, first(l));
        "quadratic-dull" quadratic_dull |s, p, l| s.span.quadratic::<_, NoHighlight, 1>(p, first(l));
        "quadratic-4-lights" quadratic_4 |s, p, l| s.span.quadratic::<_, Reflection, 4>(p, l);
        "slerp" slerp |s, p, l| s.span.slerp::<_, Reflection>(p, &first(l)[0]);
        "slerp-dull" slerp_dull |s, p, l| s.span.slerp::<_, NoHighlight>(p, &first(l)[0]);
    };
    for (name, shade) in methods {
        measure(name, shade, &rgb565, Rgb565(0), |p| u32::from(p.0));
        long_lines(name, shade, &rgb565, frame);
    }
    let methods = methods! { Rgb565Be:
        "fast-be" fast |s, p, l| s.span.fast::<_, Reflection, false, 1>(p, first(l));
    };
    for (name, shade) in methods {
        // The value must not depend on the processor's byte order.
        let value = |p: Rgb565Be| u32::from(u16::from_be_bytes(p.0.to_ne_bytes()));
        measure(name, shade, &lights(&CLAY_BE, &MORE_BE), Rgb565Be(0), value);
    }
    let methods = methods! { Rgb888:
        "naive-888" naive |s, p, l| s.span.naive::<_, Reflection, false, 1>(p, first(l));
        "fast-888" fast |s, p, l| s.span.fast::<_, Reflection, false, 1>(p, first(l));
    };
    for (name, shade) in methods {
        let value = |Rgb888([r, g, b]): Rgb888| u32::from_le_bytes([r, g, b, 0]);
        measure(
            name,
            shade,
            &lights(&CLAY_888, &MORE_888),
            Rgb888([0; 3]),
            value,
        );
    }
    #[cfg(feature = "soft")]
    for (name, shade) in soft::METHODS {
        measure(name, shade, &rgb565, Rgb565(0), |p| u32::from(p.0));
    }
    frames(first(&rgb565), frame);
    end(true)
}

#[cfg(target_os = "none")]
#[unsafe(no_mangle)]
extern "C" fn run() -> ! {
    all();
    end(true)
}

#[cfg(not(target_os = "none"))]
fn main() {
    all();
}
