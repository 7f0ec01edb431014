// Reads what scenes/view/view_bytes.h wrote. Throws RangeError where the bytes end too early.
export class ByteReader {
  constructor(bytes) {
    this.bytes = bytes;
    this.view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    this.at = 0;
  }

  left() {
    return this.bytes.length - this.at;
  }

  byte() {
    if (this.at >= this.bytes.length) throw new RangeError("the data end too early");
    return this.bytes[this.at++];
  }

  /** A whole number below 2^53. */
  count() {
    let value = 0;
    for (let scale = 1; ; scale *= 128) {
      const byte = this.byte();
      value += (byte & 0x7f) * scale;
      if (byte < 0x80) return value;
    }
  }

  signed() {
    const value = this.count();
    return value % 2 === 0 ? value / 2 : -(value + 1) / 2;
  }

  double() {
    const value = this.view.getFloat64(this.at, true);
    this.at += 8;
    return value;
  }

  short() {
    const value = this.view.getInt16(this.at, true);
    this.at += 2;
    return value;
  }

  float() {
    const value = this.view.getFloat32(this.at, true);
    this.at += 4;
    return value;
  }

  vector() {
    return [this.double(), this.double(), this.double()];
  }

  roughVector() {
    return [this.float(), this.float(), this.float()];
  }

  /** 64 bits as 16 hexadecimal digits. */
  hex() {
    const value = this.view.getBigUint64(this.at, true);
    this.at += 8;
    return value.toString(16).padStart(16, "0");
  }

  part() {
    const size = this.count();
    if (size > this.left()) throw new RangeError("the data end too early");
    const part = this.bytes.subarray(this.at, this.at + size);
    this.at += size;
    return part;
  }

  /** Adds a small signed number to each of `guess` as it comes: the one loop that has to be fast. */
  addSigned(count, into, guess) {
    const bytes = this.bytes;
    let at = this.at;
    for (let i = 0; i < count; ++i) {
      let byte = bytes[at++];
      let value = byte & 0x7f;
      for (let shift = 7; byte >= 0x80; shift += 7) {
        byte = bytes[at++];
        value |= (byte & 0x7f) << shift;
      }
      into[i] = (guess(i) + ((value >>> 1) ^ -(value & 1))) | 0;
    }
    if (at > bytes.length) throw new RangeError("the data end too early");
    this.at = at;
  }
}
