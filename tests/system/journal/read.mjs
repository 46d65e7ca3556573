// Reads an MCAP file twice with @mcap/core, by its index and as a stream, and prints what is in it as JSON.
import { McapIndexedReader, McapStreamReader } from "@mcap/core";
import { open, readFile } from "node:fs/promises";

const path = process.argv[2];
const file = await open(path);
const readable = {
  size: async () => BigInt((await file.stat()).size),
  read: async (offset, length) => {
    const buffer = new Uint8Array(Number(length));
    await file.read(buffer, 0, Number(length), Number(offset));
    return buffer;
  },
};
const reader = await McapIndexedReader.Initialize({ readable });
const counts = {}, states = {}, metadata = {}, attachments = {};
for await (const message of reader.readMessages({ validateCrcs: true })) {
  const topic = reader.channelsById.get(message.channelId).topic;
  counts[topic] = (counts[topic] ?? 0) + 1;
  if (topic !== "/kernel/decision") continue;
  const state = JSON.parse(new TextDecoder().decode(message.data)).state;
  states[state] = (states[state] ?? 0) + 1;
}
for await (const m of reader.readMetadata()) metadata[m.name] = Object.fromEntries(m.metadata);
for await (const a of reader.readAttachments()) attachments[a.name] = a.data.byteLength;

const stream = new McapStreamReader({ validateCrcs: true });
stream.append(await readFile(path));
let streamed = 0;
for (let record; (record = stream.nextRecord()); ) if (record.type === "Message") streamed++;
if (!stream.done()) throw new Error("the stream has no end");
if (BigInt(streamed) !== reader.statistics.messageCount) throw new Error(`${streamed} messages streamed, ${reader.statistics.messageCount} counted`);
console.log(JSON.stringify({ counts, states, metadata, attachments }));
