// SPDX-License-Identifier: BSD-3-Clause
// What tests/integration/list_messages prints, of an .mcap by @mcap/core and of a .bag by @foxglove/rosbag, checksums on.
// Needs @foxglove/wasm-{bz2,lz4,zstd} and @foxglove/crc, too.
import fs from "node:fs";
import { open } from "node:fs/promises";
import { crc32 } from "@foxglove/crc";
import { McapIndexedReader } from "@mcap/core";
import rosbag from "@foxglove/rosbag";
import bag_node from "@foxglove/rosbag/node.js";
import lz4 from "@foxglove/wasm-lz4";
import zstd from "@foxglove/wasm-zstd";
import bz2 from "@foxglove/wasm-bz2";

const print = (time, topic, data) =>
  process.stdout.write(`${time} ${topic} ${data.byteLength} ${crc32(data).toString(16).padStart(8, "0")}\n`);
const path = process.argv[2];

if (path.endsWith(".bag")) {
  await lz4.isLoaded;
  const unzip = await bz2.init?.();
  const bag = new rosbag.Bag(new bag_node.FileReader(path), {
    parse: false,
    decompress: {
      lz4: (bytes, size) => lz4(bytes, size),
      bz2: (bytes, size) => unzip.decompress(bytes, size, { small: false }),
    },
  });
  await bag.open();
  for await (const m of bag.messageIterator()) print(BigInt(m.timestamp.sec) * 1000000000n + BigInt(m.timestamp.nsec), m.topic, m.data);
} else {
  await zstd.isLoaded;
  await lz4.isLoaded;
  const file = await open(path);
  const readable = {
    size: async () => BigInt((await file.stat()).size),
    read: async (offset, length) => {
      const bytes = new Uint8Array(Number(length));
      await file.read(bytes, 0, Number(length), Number(offset));
      return bytes;
    },
  };
  const reader = await McapIndexedReader.Initialize({
    readable,
    decompressHandlers: {
      zstd: (bytes, size) => zstd.decompress(bytes, Number(size)),
      lz4: (bytes, size) => lz4(bytes, Number(size)),
    },
  });
  for await (const m of reader.readMessages({ validateCrcs: true }))
    print(m.logTime, reader.channelsById.get(m.channelId).topic, m.data);
}
