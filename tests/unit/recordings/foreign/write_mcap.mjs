// SPDX-License-Identifier: BSD-3-Clause
// node write_mcap.mjs FOLDER: writes mcap_{plain,zstd,bare}.mcap by the npm packages @mcap/core, @foxglove/rosmsg,
// @foxglove/rosmsg2-serialization and @foxglove/wasm-zstd: see README.md.
import fs from 'fs';
import {McapWriter} from '@mcap/core';
import {parse} from '@foxglove/rosmsg';
import {MessageWriter} from '@foxglove/rosmsg2-serialization';
import * as wasm from '@foxglove/wasm-zstd';

const zstd = wasm.default ?? wasm;
await zstd.isLoaded;
const definition = `std_msgs/Header header
uint32 height
uint32 width
string encoding
uint8 is_bigendian
uint32 step
uint8[] data
===
MSG: std_msgs/Header
builtin_interfaces/Time stamp
string frame_id
===
MSG: builtin_interfaces/Time
int32 sec
uint32 nanosec
`.replaceAll('===', '='.repeat(80));

class Output {
  bytes = [];
  length = 0;
  position() { return BigInt(this.length); }
  async write(part) {
    this.bytes.push(Buffer.from(part));
    this.length += part.byteLength;
  }
}

async function write(path, options) {
  const out = new Output();
  const writer = new McapWriter({writable: out, chunkSize: 500, ...options});
  await writer.start({profile: 'ros2', library: ''});
  const schemaId = await writer.registerSchema(
      {name: 'sensor_msgs/msg/Image', encoding: 'ros2msg', data: new TextEncoder().encode(definition)});
  const channelId = await writer.registerChannel(
      {schemaId, topic: '/cam/image_raw', messageEncoding: 'cdr', metadata: new Map()});
  const messages = new MessageWriter(parse(definition, {ros2: true}));
  for (let i = 0; i < 3; ++i) {
    const time = 1600000000n * 1000000000n + BigInt(i) * 50000000n;
    const message = {
      header: {stamp: {sec: 1600000000, nanosec: i * 50000000}, frame_id: 'cam'},
      height: 12, width: 16, encoding: 'mono8', is_bigendian: 0, step: 16,
      data: Uint8Array.from({length: 16 * 12}, (_, k) => (7 * k + 13 * i) % 256)
    };
    await writer.addMessage({channelId, sequence: i, logTime: time + 1000000n, publishTime: time,
                             data: messages.writeMessage(message)});
  }
  await writer.end();
  fs.writeFileSync(path, Buffer.concat(out.bytes));
}

const folder = process.argv[2];
await write(`${folder}/mcap_plain.mcap`, {});
await write(`${folder}/mcap_zstd.mcap`,
            {compressChunk: (bytes) => ({compression: 'zstd', compressedData: zstd.compress(bytes)})});
await write(`${folder}/mcap_bare.mcap`, {useChunks: false});
