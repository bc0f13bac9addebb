//! Rows that were written with another length than they are read with: each row of the picture
//! begins a few bytes later than the row before, and the picture leans.

/// How the bytes of a picture are laid out in fact.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rows {
    /// By how many bytes a row is longer than it was read.
    pub longer: i8,
    /// The bytes of a pixel.
    pub bytes: usize,
    /// The order of rows and channels in the file.
    pub order: Order,
}

/// The order of rows and channels in a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Order {
    /// The top row first.
    Down,
    /// The bottom row first.
    Up,
    /// As in a BMP: the bottom row first, blue first, rows padded to multiples of four bytes.
    Bmp,
}

impl Order {
    /// Returns its name in data.
    pub fn name(self) -> &'static str {
        match self {
            Order::Down => "down",
            Order::Up => "up",
            Order::Bmp => "bmp",
        }
    }
}

impl Rows {
    /// Returns the pixel and the channel that hold a channel of a pixel, for pixels that were read
    /// as `read` bytes. Returns `None` if the reader dropped the byte.
    pub fn source(
        self,
        [x, y]: [usize; 2],
        [width, height]: [usize; 2],
        channel: usize,
        read: usize,
    ) -> Option<([usize; 2], usize)> {
        let is_up = self.order != Order::Down;
        let is_bmp = self.order == Order::Bmp;
        let turned = |y: usize| if is_up { height - 1 - y } else { y };
        let swapped = |c: usize| if is_bmp && c < 3 { 2 - c } else { c };
        let padded = |row: usize| {
            if is_bmp { row.next_multiple_of(4) } else { row }
        };
        let pitch = padded(width * read);
        let stride = padded(width * self.bytes).checked_add_signed(self.longer.into())?;
        let byte = turned(y) * stride + x * self.bytes + swapped(channel);
        let (row, column) = (byte / pitch, byte % pitch);
        let is_there = row < height && column < width * read;
        is_there.then(|| ([column / read, turned(row)], swapped(column % read)))
    }

    /// Returns all layouts that differ from the one that was read.
    pub fn all(read: usize) -> impl Iterator<Item = Rows> {
        let orders = [Order::Down, Order::Up, Order::Bmp];
        let others = (-4..=4i8).filter(|longer| *longer != 0);
        let longer = others.flat_map(move |longer| {
            orders.map(|order| Rows {
                longer,
                bytes: read,
                order,
            })
        });
        // Pixels with alpha that are read without, or the other way around.
        let mixed = orders.map(|order| Rows {
            longer: 0,
            bytes: 7 - read,
            order,
        });
        longer.chain(mixed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::vec;

    /// A file is written with rows of another length and read as usual. Each byte that the reader
    /// did not drop is found again.
    #[test]
    fn bytes_are_found_where_they_were_written() {
        let size @ [width, height] = [7, 5];
        for read in [3, 4] {
            for rows in Rows::all(read) {
                let is_bmp = rows.order == Order::Bmp;
                let is_up = rows.order != Order::Down;
                let padded = |row: usize| if is_bmp { row.div_ceil(4) * 4 } else { row };
                let turned = |y: usize| if is_up { height - 1 - y } else { y };
                let swapped = |c: usize| if is_bmp && c < 3 { 2 - c } else { c };
                let value = |x: usize, y: usize, c: usize| 1 + (y * width + x) * 4 + c;
                let stride = padded(width * rows.bytes) as isize + isize::from(rows.longer);
                let mut file = vec![0; 4096];
                for y in 0..height {
                    for x in 0..width {
                        for c in 0..rows.bytes {
                            let start = turned(y) * stride as usize + x * rows.bytes;
                            file[start + swapped(c)] = value(x, y, c);
                        }
                    }
                }
                for y in 0..height {
                    for x in 0..width {
                        for c in 0..rows.bytes {
                            let Some(([column, row], channel)) = rows.source([x, y], size, c, read)
                            else {
                                continue;
                            };
                            let start = turned(row) * padded(width * read) + column * read;
                            let found = file[start + swapped(channel)];
                            // Shorter rows overlap: the next row wrote over the end of this one.
                            let is_over = rows.longer < 0 && found != value(x, y, c);
                            assert!(found == value(x, y, c) || is_over, "{rows:?} {x} {y} {c}");
                        }
                    }
                }
            }
        }
    }
}
