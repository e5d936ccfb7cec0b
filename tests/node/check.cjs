// What does the reference TypeScript reader make of an MCAP file? Every message of every topic, decoded by the schema
// that the file itself holds, with every checksum compared; one JSON line: messages by topic, and what else there is.
//
//   node check.cjs FILE.mcap

"use strict";

const fs = require("node:fs");
const { McapIndexedReader, McapStreamReader } = require("@mcap/core");
const { loadDecompressHandlers } = require("@mcap/support");
const protobuf = require("protobufjs");
const { FileDescriptorSet } = require("protobufjs/ext/descriptor");

function fail(what) {
  throw new Error(what);
}

function typeOf(schema) {
  if (schema.encoding !== "protobuf") fail(`schema ${schema.name} is ${schema.encoding}`);
  const root = protobuf.Root.fromDescriptor(FileDescriptorSet.decode(schema.data));
  root.resolveAll();
  return root.lookupType(`.${schema.name}`);
}

// Nanoseconds since 1970 of google.protobuf.Timestamp.
function nanoseconds(stamp) {
  return BigInt(stamp.seconds.toString()) * 1000000000n + BigInt(stamp.nanos);
}

// The messages that carry a timestamp of their own: the message, or its transforms or entities.
function stamped(message) {
  return [message, ...(message.transforms ?? []), ...(message.entities ?? [])].filter((part) => part.timestamp);
}

function streamed(data, decompressHandlers) {
  const reader = new McapStreamReader({ validateCrcs: true, decompressHandlers });
  const types = new Map();
  const channels = new Map();
  const topics = {};
  for (let at = 0; at < data.length; at += 1 << 20) {
    reader.append(data.subarray(at, at + (1 << 20)));
    for (let record = reader.nextRecord(); record; record = reader.nextRecord()) {
      if (record.type === "Schema") types.set(record.id, typeOf(record));
      else if (record.type === "Channel") channels.set(record.id, record);
      else if (record.type === "Message") {
        const channel = channels.get(record.channelId);
        const message = types.get(channel.schemaId).decode(record.data);
        for (const part of stamped(message)) {
          if (nanoseconds(part.timestamp) !== record.logTime) fail(`${channel.topic}: timestamp is not the log time`);
        }
        topics[channel.topic] = (topics[channel.topic] ?? 0) + 1;
      }
    }
  }
  if (!reader.done()) fail("the file does not end");
  return topics;
}

async function indexed(data, decompressHandlers) {
  const readable = {
    size: async () => BigInt(data.length),
    read: async (offset, length) => data.subarray(Number(offset), Number(offset + length)),
  };
  const reader = await McapIndexedReader.Initialize({ readable, decompressHandlers });
  let messages = 0;
  let last = 0n;
  for await (const message of reader.readMessages()) {
    if (message.logTime < last) fail("messages are not in time order");
    last = message.logTime;
    messages += 1;
  }
  const attachments = [];
  for await (const item of reader.readAttachments()) attachments.push(item.name); // compares its checksum
  const metadata = [];
  for await (const item of reader.readMetadata()) metadata.push(item.name);
  if (BigInt(messages) !== reader.statistics.messageCount) fail("the statistics count other messages");
  return { messages, attachments, metadata };
}

async function main(path) {
  const data = fs.readFileSync(path);
  const decompressHandlers = await loadDecompressHandlers();
  const topics = streamed(data, decompressHandlers);
  console.log(JSON.stringify({ topics, ...(await indexed(data, decompressHandlers)) }));
}

main(process.argv[2]).catch((error) => {
  console.error(error.message);
  process.exit(1);
});
