//! Vertex normals, in model space.

use crate::options::{NormalIndex, NormalSource as Source, Options, PolygonNormal, VertexNormal};
use crate::triangulate::{newell, triangulate};
use fastphong::mesh::PolygonMesh;
use fastphong::mesh::vertex_normals::NormalSource;
use glam::{DVec3, Vec3};
use std::collections::HashMap;

/// The normals of a mesh, in model space.
pub struct Normals {
    /// A vector for each corner of the mesh. It has length 1 unless a mistake changes that.
    pub corners: Vec<DVec3>,
    /// A unit vector for each polygon; 0 for a polygon without area.
    pub polygons: Vec<DVec3>,
}

/// The corners that share an average.
#[derive(Clone, Copy)]
enum Smoothing {
    /// The corners on one surface and in one smoothing group.
    Groups,
    /// The corners on one surface.
    Surfaces,
    /// The corners on one surface whose polygons' normals have at least this cosine.
    Crease(f64),
}

/// Computes the normals of `mesh` from `source`.
pub fn normals(mesh: &PolygonMesh, source: NormalSource, options: &Options) -> Normals {
    if options.normal_source == Source::Positions {
        of_positions(mesh)
    } else {
        of_surface(mesh, source, options)
    }
}

/// Takes the positions of `mesh` as its normals.
fn of_positions(mesh: &PolygonMesh) -> Normals {
    let mut points = Vec::new();
    let mut normals = Normals {
        corners: Vec::new(),
        polygons: Vec::new(),
    };
    for p in 0..mesh.polygon_count() {
        corners_of(mesh, p, &mut points);
        normals.polygons.push(unit_or_zero(newell(&points)));
        let directions = points
            .iter()
            .map(|point| unit_or_zero(*point + mesh.origin()));
        normals.corners.extend(directions);
    }
    normals
}

/// Returns the place in a list of `count` normals that the student reads for place `index`.
fn read_at(index: usize, count: usize, how: NormalIndex) -> usize {
    match how {
        NormalIndex::Own => index,
        NormalIndex::Before => (index + count - 1) % count,
        NormalIndex::After => (index + 1) % count,
    }
}

/// Exchanges the normals of corners for those of the vertices beside them in the file's list. A
/// vertex with several normals counts with that of its first corner.
fn exchange(mesh: &PolygonMesh, corners: &mut [DVec3], how: NormalIndex) {
    let mut of_vertex = vec![None; mesh.positions().len()];
    for (&vertex, normal) in mesh.corners().iter().zip(corners.iter()) {
        of_vertex[vertex as usize].get_or_insert(*normal);
    }
    for (&vertex, normal) in mesh.corners().iter().zip(corners) {
        let other = of_vertex[read_at(vertex as usize, of_vertex.len(), how)];
        *normal = other.unwrap_or(*normal);
    }
}

/// Computes the normals of `mesh` from its surface, or takes its own.
fn of_surface(mesh: &PolygonMesh, source: NormalSource, options: &Options) -> Normals {
    let mut points = Vec::new();
    let mut sums = Vec::with_capacity(mesh.polygon_count());
    for p in 0..mesh.polygon_count() {
        corners_of(mesh, p, &mut points);
        sums.push(polygon_normal(&points, options.polygon_normal));
    }
    let polygons: Vec<DVec3> = sums.iter().map(|&sum| unit_or_zero(sum)).collect();
    let (takes_given, smoothing) = rule(source, options.normal_source);
    let given = takes_given.then(|| mesh.given_normals()).flatten();
    let given_at = |corner: usize| {
        let given = given?;
        let index = match &given.corners {
            Some(corners) => corners[corner],
            None => mesh.corners()[corner],
        };
        let index = read_at(index as usize, given.values.len(), options.normal_index);
        let normal = given.values[index].as_dvec3();
        (normal != DVec3::ZERO).then(|| unit_or_zero(normal))
    };
    let count = mesh.corners().len();
    if (0..count).all(|corner| given_at(corner).is_some()) {
        let corners = (0..count).filter_map(given_at).collect();
        return Normals { corners, polygons };
    }
    let mut corners = averages(mesh, &sums, &polygons, smoothing, options);
    if options.normal_index != NormalIndex::Own {
        exchange(mesh, &mut corners, options.normal_index);
    }
    for (corner, normal) in corners.iter_mut().enumerate() {
        *normal = given_at(corner).unwrap_or(*normal);
    }
    Normals { corners, polygons }
}

/// Returns true if the mesh's own normals are used, and the corners that share an average.
fn rule(source: NormalSource, wrong: Source) -> (bool, Smoothing) {
    let (takes_given, smoothing) = match source {
        NormalSource::Averaged => (false, Smoothing::Groups),
        NormalSource::Auto => (true, Smoothing::Groups),
        NormalSource::Given => (true, Smoothing::Surfaces),
        NormalSource::Crease(degrees) => (false, Smoothing::Crease(degrees.to_radians().cos())),
    };
    match wrong {
        Source::OfScene | Source::Positions => (takes_given, smoothing),
        Source::AlwaysAveraged => (false, smoothing),
        Source::AlwaysGiven => (true, smoothing),
        Source::WithoutCrease => match smoothing {
            Smoothing::Crease(_) => (takes_given, Smoothing::Surfaces),
            _ => (takes_given, smoothing),
        },
    }
}

/// Writes the corners of polygon `p` to `out`.
pub fn corners_of(mesh: &PolygonMesh, p: usize, out: &mut Vec<DVec3>) {
    let positions = mesh.positions();
    out.clear();
    for &c in mesh.polygon(p) {
        out.push(positions[c as usize].as_dvec3());
    }
}

fn polygon_normal(points: &[DVec3], how: PolygonNormal) -> DVec3 {
    match how {
        PolygonNormal::Newell => newell(points),
        PolygonNormal::Reversed => -newell(points),
        PolygonNormal::FirstCorner => (points[1] - points[0]).cross(points[2] - points[1]),
    }
}

/// Returns the unit vector along `vector`; 0 if `vector` is 0 up to rounding.
fn unit_or_zero(vector: DVec3) -> DVec3 {
    let length = vector.dot(vector).sqrt();
    if length > 1e-30 {
        vector / length
    } else {
        DVec3::ZERO
    }
}

/// Returns the vector that each corner adds to the sum at its vertex, if it is not its polygon's
/// unit normal.
fn contributions(
    mesh: &PolygonMesh,
    sums: &[DVec3],
    polygons: &[DVec3],
    how: VertexNormal,
) -> Option<Vec<DVec3>> {
    if matches!(
        how,
        VertexNormal::UnitNormals | VertexNormal::LastPolygon | VertexNormal::SumKept
    ) {
        return None;
    }
    let mut added = Vec::with_capacity(mesh.corners().len());
    let (mut points, mut triangles) = (Vec::new(), Vec::new());
    for p in 0..mesh.polygon_count() {
        let corners = mesh.polygon(p).len();
        corners_of(mesh, p, &mut points);
        match how {
            VertexNormal::AreaWeighted => added.extend((0..corners).map(|_| sums[p])),
            VertexNormal::AngleWeighted => {
                added.extend((0..corners).map(|i| angle(&points, i) * polygons[p]));
            }
            VertexNormal::EachTriangle => {
                triangulate(&points, 0, Default::default(), &mut triangles);
                let first = added.len();
                added.resize(first + corners, DVec3::ZERO);
                for triangle in &triangles {
                    let normal = unit_or_zero(newell(&triangle.map(|i| points[i])));
                    triangle.iter().for_each(|&i| added[first + i] += normal);
                }
            }
            _ => {}
        }
    }
    Some(added)
}

/// Returns the angle of a polygon at its corner `i`.
fn angle(points: &[DVec3], i: usize) -> f64 {
    let count = points.len();
    let to_next = points[(i + 1) % count] - points[i];
    let to_last = points[(i + count - 1) % count] - points[i];
    unit_or_zero(to_next)
        .dot(unit_or_zero(to_last))
        .clamp(-1.0, 1.0)
        .acos()
}

/// Returns the vertex of each corner, and how many vertices there are. Equal positions are one
/// vertex.
fn vertices(mesh: &PolygonMesh) -> (Vec<u32>, usize) {
    let mut known = HashMap::with_capacity(mesh.positions().len());
    let mut number_of = |p: &Vec3| {
        let next = known.len() as u32;
        // −0 and 0 are equal. Hashing one word is faster than hashing three.
        let bits = |c: f32| u128::from((c + 0.0).to_bits());
        let key = bits(p.x) << 64 | bits(p.y) << 32 | bits(p.z);
        *known.entry(key).or_insert(next)
    };
    let numbers: Vec<u32> = mesh.positions().iter().map(&mut number_of).collect();
    let of_corners = mesh.corners().iter().map(|&c| numbers[c as usize]);
    (of_corners.collect(), known.len())
}

/// A corner at a vertex.
#[derive(Clone, Copy)]
struct Spoke {
    corner: u32,
    polygon: u32,
    /// The vertices after and before the corner in its polygon.
    next: u32,
    last: u32,
}

/// Returns all corners, vertex after vertex, and the start of each vertex.
fn spokes(mesh: &PolygonMesh, vertex: &[u32], count: usize) -> (Vec<Spoke>, Vec<usize>) {
    let mut starts = vec![0; count + 1];
    for &v in vertex {
        starts[v as usize + 1] += 1;
    }
    for v in 0..count {
        starts[v + 1] += starts[v];
    }
    let mut at = starts.clone();
    let nothing = Spoke {
        corner: 0,
        polygon: 0,
        next: 0,
        last: 0,
    };
    let mut spokes = vec![nothing; vertex.len()];
    for p in 0..mesh.polygon_count() {
        let range = mesh.corner_range(p);
        let corners = &vertex[range.clone()];
        let size = corners.len();
        for (i, &v) in corners.iter().enumerate() {
            spokes[at[v as usize]] = Spoke {
                corner: (range.start + i) as u32,
                polygon: p as u32,
                next: corners[(i + 1) % size],
                last: corners[(i + size - 1) % size],
            };
            at[v as usize] += 1;
        }
    }
    (spokes, starts)
}

/// Writes the surface of each corner at a vertex to `surface`. Two corners are on one surface if
/// edges link them along which their polygons run in opposite directions.
fn find_surfaces(mesh: &PolygonMesh, around: &[Spoke], surface: &mut Vec<usize>) {
    surface.clear();
    surface.extend(0..around.len());
    for i in 0..around.len() {
        for j in i + 1..around.len() {
            let (a, b) = (&around[i], &around[j]);
            let is_linked = a.next == b.last || a.last == b.next;
            let (from, to) = (surface[i], surface[j]);
            if is_linked
                && from != to
                && mesh.part(a.polygon as usize) == mesh.part(b.polygon as usize)
            {
                surface
                    .iter_mut()
                    .filter(|s| **s == to)
                    .for_each(|s| *s = from);
            }
        }
    }
}

fn averages(
    mesh: &PolygonMesh,
    sums: &[DVec3],
    polygons: &[DVec3],
    smoothing: Smoothing,
    options: &Options,
) -> Vec<DVec3> {
    let (vertex, count) = vertices(mesh);
    let (spokes, starts) = spokes(mesh, &vertex, count);
    let added = contributions(mesh, sums, polygons, options.vertex_normal);
    let added = |spoke: &Spoke| match &added {
        Some(added) => added[spoke.corner as usize],
        None => polygons[spoke.polygon as usize],
    };
    let mut normals = vec![DVec3::Z; vertex.len()];
    let mut surface = Vec::new();
    let mut known: Vec<DVec3> = Vec::new();
    let group = |spoke: &Spoke| mesh.smoothing_group(spoke.polygon as usize);
    for v in 0..count {
        let around = &spokes[starts[v]..starts[v + 1]];
        find_surfaces(mesh, around, &mut surface);
        known.clear();
        for (i, spoke) in around.iter().enumerate() {
            let own = polygons[spoke.polygon as usize];
            // The corners that share an average with corner i.
            let shares = |j: usize| {
                surface[i] == surface[j]
                    && match smoothing {
                        Smoothing::Groups => {
                            let of_i = group(spoke);
                            of_i == group(&around[j]) && of_i != Some(PolygonMesh::FACETED)
                        }
                        Smoothing::Surfaces => true,
                        Smoothing::Crease(_) => false,
                    }
            };
            let is_averaged = |j: usize| match smoothing {
                Smoothing::Crease(cosine) => {
                    let other = polygons[around[j].polygon as usize];
                    surface[i] == surface[j] && own.dot(other) >= cosine - 1e-9
                }
                _ => i == j || shares(j),
            };
            let sum = match (0..i).find(|&j| shares(j)) {
                Some(j) => known[j],
                None => sum(around, added, options.vertex_normal, is_averaged),
            };
            known.push(sum);
            normals[spoke.corner as usize] = direction(sum, own, options.vertex_normal);
        }
    }
    normals
}

/// Returns the normal at a corner: the direction of the sum at its vertex, or the polygon's own
/// normal if the sum vanishes.
fn direction(sum: DVec3, own: DVec3, how: VertexNormal) -> DVec3 {
    let length = sum.dot(sum).sqrt();
    if length > 1e-12 {
        if how == VertexNormal::SumKept {
            sum
        } else {
            sum / length
        }
    } else if own != DVec3::ZERO {
        own
    } else {
        DVec3::Z
    }
}

/// Adds up the contributions of the corners at a vertex. Each polygon counts once.
fn sum(
    around: &[Spoke],
    added: impl Fn(&Spoke) -> DVec3,
    how: VertexNormal,
    is_averaged: impl Fn(usize) -> bool,
) -> DVec3 {
    let mut sum = DVec3::ZERO;
    let mut latest = u32::MAX;
    for (j, spoke) in around.iter().enumerate() {
        if !is_averaged(j) || spoke.polygon == latest {
            continue;
        }
        latest = spoke.polygon;
        let normal = added(spoke);
        match how {
            VertexNormal::LastPolygon if normal != DVec3::ZERO => sum = normal,
            _ => sum += normal,
        }
    }
    sum
}
