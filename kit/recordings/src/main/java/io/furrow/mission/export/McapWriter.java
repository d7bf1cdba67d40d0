package io.furrow.mission.export;

import java.io.IOException;
import java.io.OutputStream;
import java.util.SortedMap;
import java.util.TreeMap;
import java.util.zip.CRC32;

/**
 * Writes an MCAP file (version 0, https://mcap.dev/spec): uncompressed chunks with an index of their messages, then the
 * summary, with which a reader seeks by time or topic. Holds one chunk, and about 100 bytes for each written chunk.
 */
final class McapWriter {
    static final int MAX_CHANNELS = 65_535;

    private static final byte[] MAGIC = {(byte) 0x89, 'M', 'C', 'A', 'P', '0', '\r', '\n'};
    private static final int CHUNK_BYTES = 1024 * 1024;

    /** The kinds of records. */
    enum Opcode {
        HEADER(0x01),
        FOOTER(0x02),
        SCHEMA(0x03),
        CHANNEL(0x04),
        MESSAGE(0x05),
        CHUNK(0x06),
        MESSAGE_INDEX(0x07),
        CHUNK_INDEX(0x08),
        STATISTICS(0x0B),
        SUMMARY_OFFSET(0x0E),
        DATA_END(0x0F);

        private final int code;

        Opcode(int code) {
            this.code = code;
        }

        int code() {
            return code;
        }
    }

    private final OutputStream out;
    private final CRC32 crc = new CRC32();
    private long offset;

    private final McapBuffer schemas = new McapBuffer();
    private final McapBuffer channels = new McapBuffer();
    private final McapBuffer chunkIndexes = new McapBuffer();
    private int schemaCount;
    private int chunkCount;
    private final SortedMap<Integer, Long> messages = new TreeMap<>();
    private final Extent all = new Extent();

    private McapBuffer chunk = new McapBuffer();
    private Extent chunkExtent = new Extent();
    private final SortedMap<Integer, McapBuffer> chunkMessages = new TreeMap<>();

    /** First and last log time, in nanoseconds; zero if there is none. */
    private static final class Extent {
        private long first;
        private long last;
        private boolean any;

        void add(long time) {
            first = any ? Math.min(first, time) : time;
            last = any ? Math.max(last, time) : time;
            any = true;
        }
    }

    McapWriter(OutputStream out, String library) throws IOException {
        this.out = out;
        write(MAGIC);
        write(new McapBuffer()
                .record(Opcode.HEADER, new McapBuffer().text("").text(library))
                .toArray());
    }

    /** Adds a schema and returns its id. */
    int schema(String name, String encoding, byte[] data) {
        schemaCount++;
        McapBuffer content =
                new McapBuffer().u16(schemaCount).text(name).text(encoding).prefixed(data);
        schemas.record(Opcode.SCHEMA, content);
        chunk.record(Opcode.SCHEMA, content);
        return schemaCount;
    }

    /** Adds a channel and returns its id; the maximum is {@value #MAX_CHANNELS} channels. */
    int channel(int schema, String topic, String encoding, SortedMap<String, String> metadata) {
        int id = messages.size() + 1;
        McapBuffer content =
                new McapBuffer().u16(id).u16(schema).text(topic).text(encoding).texts(metadata);
        channels.record(Opcode.CHANNEL, content);
        chunk.record(Opcode.CHANNEL, content);
        messages.put(id, 0L);
        return id;
    }

    int channels() {
        return messages.size();
    }

    /** @param nanos log time and publish time since 1970, unsigned */
    void message(int channel, long nanos, byte[] data) throws IOException {
        long sequence = messages.merge(channel, 1L, Long::sum) - 1;
        chunkMessages
                .computeIfAbsent(channel, ignored -> new McapBuffer())
                .u64(nanos)
                .u64(chunk.size());
        chunk.record(
                Opcode.MESSAGE,
                new McapBuffer()
                        .u16(channel)
                        .u32(sequence)
                        .u64(nanos)
                        .u64(nanos)
                        .raw(data));
        chunkExtent.add(nanos);
        all.add(nanos);
        if (chunk.size() >= CHUNK_BYTES) {
            endChunk();
        }
    }

    private void endChunk() throws IOException {
        byte[] records = chunk.toArray();
        CRC32 ofRecords = new CRC32();
        ofRecords.update(records);
        long start = offset;
        write(new McapBuffer()
                .record(
                        Opcode.CHUNK,
                        new McapBuffer()
                                .u64(chunkExtent.first)
                                .u64(chunkExtent.last)
                                .u64(records.length)
                                .u32(ofRecords.getValue())
                                .text("")
                                .u64(records.length)
                                .raw(records))
                .toArray());
        long end = offset;
        SortedMap<Integer, Long> indexes = new TreeMap<>();
        for (var messagesOfChannel : chunkMessages.entrySet()) {
            indexes.put(messagesOfChannel.getKey(), offset);
            write(new McapBuffer()
                    .record(
                            Opcode.MESSAGE_INDEX,
                            new McapBuffer()
                                    .u16(messagesOfChannel.getKey())
                                    .prefixed(messagesOfChannel.getValue().toArray()))
                    .toArray());
        }
        chunkIndexes.record(
                Opcode.CHUNK_INDEX,
                new McapBuffer()
                        .u64(chunkExtent.first)
                        .u64(chunkExtent.last)
                        .u64(start)
                        .u64(end - start)
                        .byChannel(indexes)
                        .u64(offset - end)
                        .text("")
                        .u64(records.length)
                        .u64(records.length));
        chunkCount++;
        chunk = new McapBuffer();
        chunkExtent = new Extent();
        chunkMessages.clear();
    }

    /** Ends the file; the stream stays open. */
    void finish() throws IOException {
        if (chunk.size() > 0) {
            endChunk();
        }
        write(new McapBuffer()
                .record(Opcode.DATA_END, new McapBuffer().u32(crc.getValue()))
                .toArray());
        crc.reset();
        long summary = offset;
        McapBuffer offsets = new McapBuffer();
        group(Opcode.SCHEMA, schemas, offsets);
        group(Opcode.CHANNEL, channels, offsets);
        group(Opcode.STATISTICS, new McapBuffer().record(Opcode.STATISTICS, statistics()), offsets);
        group(Opcode.CHUNK_INDEX, chunkIndexes, offsets);
        long summaryOffsets = offset;
        write(offsets.toArray());
        footer(summary, summaryOffsets);
        write(MAGIC);
        out.flush();
    }

    private void group(Opcode opcode, McapBuffer records, McapBuffer offsets) throws IOException {
        if (records.size() > 0) {
            offsets.record(
                    Opcode.SUMMARY_OFFSET,
                    new McapBuffer().u8(opcode.code()).u64(offset).u64(records.size()));
            write(records.toArray());
        }
    }

    private McapBuffer statistics() {
        long count = messages.values().stream().mapToLong(Long::longValue).sum();
        return new McapBuffer()
                .u64(count)
                .u16(schemaCount)
                .u32(messages.size())
                .u32(0)
                .u32(0)
                .u32(chunkCount)
                .u64(all.first)
                .u64(all.last)
                .byChannel(messages);
    }

    /** Writes the footer; its checksum covers the summary and the footer up to the checksum. */
    private void footer(long summary, long summaryOffsets) throws IOException {
        McapBuffer start = new McapBuffer()
                .u8(Opcode.FOOTER.code())
                .u64(2 * Long.BYTES + Integer.BYTES)
                .u64(summary)
                .u64(summaryOffsets);
        write(start.toArray());
        write(new McapBuffer().u32(crc.getValue()).toArray());
    }

    private void write(byte[] bytes) throws IOException {
        out.write(bytes);
        crc.update(bytes);
        offset += bytes.length;
    }
}
