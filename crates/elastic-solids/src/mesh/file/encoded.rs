//! Bytes in base64 and compressed by zlib, as in XML files of VTK.

/// Most bytes of an array.
const MOST_BYTES: usize = 1 << 28;

/// Returns the bytes of a text in base64 up to the end of its first complete part, and the length of the text that they
/// took; blanks are left out. Parts that end in `=` follow one another in XML files of VTK.
pub(super) fn base64(text: &[u8]) -> Option<(Vec<u8>, usize)> {
    let mut bytes = Vec::with_capacity(text.len() / 4 * 3);
    let (mut bits, mut count, mut padding) = (0u32, 0, 0);
    for (place, &sign) in text.iter().enumerate() {
        let value = match sign {
            b'A'..=b'Z' => sign - b'A',
            b'a'..=b'z' => sign - b'a' + 26,
            b'0'..=b'9' => sign - b'0' + 52,
            b'+' => 62,
            b'/' => 63,
            b'=' => {
                padding += 1;
                0
            }
            sign if sign.is_ascii_whitespace() => continue,
            _ => return None,
        };
        if padding > 0 && sign != b'=' {
            return None;
        }
        bits = (bits << 6) | u32::from(value);
        count += 1;
        if count == 4 {
            let [_, first, second, third] = bits.to_be_bytes();
            bytes.extend([first, second, third].into_iter().take(3usize.checked_sub(padding)?));
            if padding > 0 {
                return Some((bytes, place + 1));
            }
            (bits, count) = (0, 0);
        }
    }
    (count == 0).then_some((bytes, text.len()))
}

/// How the bytes of arrays are written.
#[derive(Debug, Clone, Copy)]
pub(super) struct Encoding {
    /// True if lengths have eight bytes, not four.
    pub(super) long: bool,
    pub(super) big_endian: bool,
    pub(super) zlib: bool,
}

impl Encoding {
    fn size(self) -> usize {
        if self.long { 8 } else { 4 }
    }

    /// Returns whole numbers at the start of bytes.
    fn lengths<const N: usize>(self, bytes: &[u8], from: usize) -> Option<[usize; N]> {
        let mut found = [0; N];
        for (k, value) in found.iter_mut().enumerate() {
            let start = from + k * self.size();
            let mut part = [0; 8];
            part[..self.size()].copy_from_slice(bytes.get(start..start + self.size())?);
            if self.big_endian {
                part[..self.size()].reverse();
            }
            *value = usize::try_from(u64::from_le_bytes(part)).ok().filter(|value| *value <= MOST_BYTES)?;
        }
        Some(found)
    }

    /// Returns the bytes of an array that starts with its lengths. In base64, the lengths of a compressed array are a
    /// separate part.
    pub(super) fn decode(self, source: &[u8], in_base64: bool) -> Option<Vec<u8>> {
        let whole = |text: &[u8]| if in_base64 { base64(text) } else { Some((text.to_vec(), text.len())) };
        if !self.zlib {
            let (bytes, _) = whole(source)?;
            let [length] = self.lengths(&bytes, 0)?;
            return bytes.get(self.size()..self.size().checked_add(length)?).map(<[u8]>::to_vec);
        }
        // Number of blocks, their size, and the size of the last one, then the compressed size of each.
        let first =
            if in_base64 { base64(&source[..source.len().min(3 * self.size() * 4 / 3)])?.0 } else { source.to_vec() };
        let [blocks, size, last] = self.lengths(&first, 0)?;
        if blocks == 0 {
            return Some(Vec::new());
        }
        let head = self.size().checked_mul(blocks.checked_add(3)?)?;
        let (header, body) = if in_base64 {
            let signs = head.div_ceil(3).checked_mul(4)?;
            (base64(source.get(..signs)?)?.0, base64(source.get(signs..)?)?.0)
        } else {
            (source.get(..head)?.to_vec(), source.get(head..)?.to_vec())
        };
        let (mut bytes, mut at) = (Vec::new(), 0usize);
        for block in 0..blocks {
            let [length] = self.lengths(&header, self.size() * (3 + block))?;
            let end = at.checked_add(length)?;
            let expected = if block + 1 == blocks && last > 0 { last } else { size };
            if bytes.len().checked_add(expected)? > MOST_BYTES {
                return None;
            }
            let part = miniz_oxide::inflate::decompress_to_vec_zlib_with_limit(body.get(at..end)?, expected).ok()?;
            bytes.extend(part);
            at = end;
        }
        Some(bytes)
    }
}
