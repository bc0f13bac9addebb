//! What a batch reads of its triangles: where they lie, and later, of those that are drawn, what is interpolated over them.

use super::batch::{Batch, MOST, each_bit};
use super::facets::LINE;
use crate::frame::Frame;
use crate::number::{Lanes, Planes, put_each};
use crate::raster::bins::Listed;
use crate::walk::Attribute;

/// Where the numbers of pixels are.
#[derive(Clone, Copy, Debug)]
pub(super) enum Numbers<'a, A, Q> {
    /// In the attributes of vertices.
    Attributes(&'a [A]),
    /// They are those of the vertices' own normals.
    Normals(&'a [[f32; 3]]),
    /// In the values of polygons.
    Polygons(&'a [Q]),
}

impl Batch {
    /// Reads the places of triangles from the front of `polygons` until there are enough, or a polygon has another shape; gives how
    /// many.
    ///
    /// In a loop of its own, in which nothing has to be guessed: so the reads of many triangles overlap. Their places in memory
    /// are far from one another, and waiting for them took a third of the time.
    #[inline(always)]
    pub fn read(&mut self, frame: &Frame, polygons: &[Listed]) -> usize {
        let (vertices, most) = (frame.vertices(), polygons.len().min(MOST));
        let polygons = &polygons[..most];
        let mut k = 0;
        while k < most && polygons[k].is_triangle() {
            self.listed[k] = polygons[k];
            let mut i = 0;
            while i < 3 {
                let vertex = &vertices[polygons[k].corners[i] as usize];
                (self.x[i][k], self.y[i][k]) = (vertex.x.to_bits(), vertex.y.to_bits());
                i += 1;
            }
            k += 1;
        }
        self.count = k;
        k
    }

    /// Reads the depths of the corners of those triangles whose bits `drawn` has, and sets up their facets. Again in a loop of its own.
    #[inline(always)]
    pub(super) fn read_depths<M: Lanes>(&mut self, m: M, frame: &Frame, drawn: u32) {
        let vertices = frame.vertices();
        self.read_lines(
            m,
            (drawn, 1),
            #[inline(always)]
            |_, corner, line| line[0] = vertices[corner].depth,
        );
    }

    /// The same with `numbers`: there are `facets` of both.
    #[inline(always)]
    pub(super) fn read_numbers<M: Lanes, A: Attribute<f32>, Q: Planes<f32>>(
        &mut self,
        m: M,
        frame: &Frame,
        (numbers, facets): (Numbers<'_, A, Q>, usize),
        drawn: u32,
    ) {
        let vertices = frame.vertices();
        match numbers {
            Numbers::Attributes(attributes) => {
                // Bounded once for both.
                let count = vertices.len().min(attributes.len());
                let (vertices, attributes) = (&vertices[..count], &attributes[..count]);
                self.read_lines(
                    m,
                    (drawn, facets),
                    #[inline(always)]
                    |_, corner, line| {
                        line[0] = vertices[corner].depth;
                        let mut i = 1;
                        each_number(
                            attributes[corner],
                            #[inline(always)]
                            |number| {
                                line[i] = number;
                                i += 1;
                            },
                        );
                    },
                );
            }
            Numbers::Normals(normals) => {
                let count = vertices.len().min(normals.len());
                let (vertices, normals) = (&vertices[..count], &normals[..count]);
                self.read_lines(
                    m,
                    (drawn, facets),
                    #[inline(always)]
                    |_, corner, line| {
                        let [x, y, z] = normals[corner];
                        (line[0], line[1], line[2], line[3]) = (vertices[corner].depth, x, y, z);
                    },
                );
            }
            Numbers::Polygons(polygons) => self.read_lines(
                m,
                (drawn, facets),
                #[inline(always)]
                |polygon, corner, line| {
                    line[0] = vertices[corner].depth;
                    let mut i = 1;
                    put_each(
                        polygons[polygon],
                        #[inline(always)]
                        |number| {
                            line[i] = number;
                            i += 1;
                        },
                    );
                },
            ),
        }
    }

    /// Reads the materials of those triangles.
    #[inline(always)]
    pub(super) fn read_materials(&mut self, frame: &Frame, drawn: u32) {
        each_bit(
            drawn,
            #[inline(always)]
            |k| self.material[k] = frame.polygons()[self.listed[k].number as usize].material,
        );
    }

    /// Has `read` read each corner of those triangles whose bits `drawn` has, for the number of its polygon, and sets up their facets.
    #[inline(always)]
    fn read_lines<M: Lanes>(
        &mut self,
        m: M,
        (drawn, facets): (u32, usize),
        mut read: impl FnMut(usize, usize, &mut [f32; LINE]),
    ) {
        each_bit(
            drawn,
            #[inline(always)]
            |k| {
                let Listed {
                    number,
                    corners: [a, b, c],
                } = self.listed[k];
                let number = number as usize;
                let (mut at, mut to_b, mut to_c) = ([0.0; LINE], [0.0; LINE], [0.0; LINE]);
                read(number, a as usize, &mut at);
                read(number, b as usize, &mut to_b);
                read(number, c as usize, &mut to_c);
                let to = &mut self.facets.0[k];
                let mut i = 0;
                while i < facets {
                    let from = m.load(&at[i..]);
                    m.store(from, &mut to[0][i..]);
                    m.store(m.load(&to_b[i..]) - from, &mut to[1][i..]);
                    m.store(m.load(&to_c[i..]) - from, &mut to[2][i..]);
                    i += M::WIDTH;
                }
            },
        );
    }
}

/// Gives the numbers of an attribute, to what must be inlined.
#[inline(always)]
fn each_number<A: Attribute<f32>>(attribute: A, mut to: impl FnMut(f32)) {
    attribute.numbers(&mut to);
}
