package io.furrow.mission.export;

import java.nio.ByteBuffer;
import java.nio.ByteOrder;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;
import java.util.zip.CRC32;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

/** Parses an MCAP file according to its specification and checks every length, offset, count and checksum. */
final class McapFile {
    private static final byte[] MAGIC = {(byte) 0x89, 'M', 'C', 'A', 'P', '0', '\r', '\n'};
    private static final int FOOTER_BYTES = 1 + 8 + 8 + 8 + 4;

    final List<Message> messages = new ArrayList<>();
    final Map<Integer, String> schemas = new TreeMap<>();
    final Map<Integer, Channel> channels = new TreeMap<>();
    int chunks;

    private final ByteBuffer file;
    private final Map<Integer, Long> counts = new TreeMap<>();

    record Message(String topic, long nanos, String data) {}

    record Channel(int schema, String topic, Map<String, String> metadata) {}

    private record Block(int opcode, long start, ByteBuffer content, long end) {}

    McapFile(byte[] bytes) {
        file = ByteBuffer.wrap(bytes).order(ByteOrder.LITTLE_ENDIAN);
        assertThat(Arrays.copyOf(bytes, MAGIC.length)).isEqualTo(MAGIC);
        assertThat(Arrays.copyOfRange(bytes, bytes.length - MAGIC.length, bytes.length))
                .isEqualTo(MAGIC);
        int footerAt = bytes.length - MAGIC.length - FOOTER_BYTES;
        Block footer = block(file, footerAt);
        assertThat(footer.opcode).isEqualTo(2);
        long summary = footer.content.getLong();
        long summaryOffsets = footer.content.getLong();
        assertThat(unsigned(footer.content.getInt())).isEqualTo(crc(summary, bytes.length - MAGIC.length - 4));
        readData(summary);
        readSummary(summary, summaryOffsets);
        readOffsets(summary, summaryOffsets, footerAt);
    }

    private void readData(long end) {
        Block header = block(file, MAGIC.length);
        assertThat(header.opcode).isEqualTo(1);
        assertThat(text(header.content)).isEmpty();
        assertThat(text(header.content)).isEqualTo("furrow");
        long at = header.end;
        Block last = header;
        while (at < end) {
            last = block(file, (int) at);
            if (last.opcode == 6) {
                readChunk(last.content);
            } else {
                assertThat(last.opcode).isIn(7, 15);
            }
            at = last.end;
        }
        assertThat(last.opcode).isEqualTo(15);
        assertThat(unsigned(last.content.getInt())).isEqualTo(crc(0, last.start));
    }

    private void readChunk(ByteBuffer chunk) {
        chunks++;
        ByteBuffer records = records(chunk);
        int at = 0;
        while (at < records.limit()) {
            Block block = block(records, at);
            ByteBuffer in = block.content;
            switch (block.opcode) {
                case 3 -> schemas.put((int) in.getShort(), text(in) + " " + text(in) + " " + text(in));
                case 4 -> channels.put((int) in.getShort(), channel(in));
                case 5 -> {
                    int channel = in.getShort();
                    assertThat(unsigned(in.getInt())).isEqualTo(counts.merge(channel, 1L, Long::sum) - 1);
                    long nanos = in.getLong();
                    assertThat(in.getLong()).isEqualTo(nanos);
                    String data = UTF_8.decode(in).toString();
                    messages.add(new Message(channels.get(channel).topic, nanos, data));
                }
                default -> throw new AssertionError("opcode " + block.opcode + " in a chunk");
            }
            at = (int) block.end;
        }
    }

    private static Channel channel(ByteBuffer in) {
        int schema = in.getShort();
        String topic = text(in);
        assertThat(text(in)).isEqualTo("json");
        Map<String, String> metadata = new TreeMap<>();
        int end = in.getInt() + in.position();
        while (in.position() < end) {
            metadata.put(text(in), text(in));
        }
        return new Channel(schema, topic, metadata);
    }

    private static ByteBuffer records(ByteBuffer chunk) {
        long first = chunk.getLong();
        long last = chunk.getLong();
        assertThat(first).isLessThanOrEqualTo(last);
        long size = chunk.getLong();
        long crc = unsigned(chunk.getInt());
        assertThat(text(chunk)).isEmpty();
        assertThat(chunk.getLong()).isEqualTo(size).isEqualTo(chunk.remaining());
        CRC32 actual = new CRC32();
        actual.update(chunk.duplicate());
        assertThat(crc).isEqualTo(actual.getValue());
        return chunk.slice().order(ByteOrder.LITTLE_ENDIAN);
    }

    private void readSummary(long summary, long end) {
        int indexed = 0;
        int indexes = 0;
        for (long at = summary; at < end; ) {
            Block block = block(file, (int) at);
            at = block.end;
            if (block.opcode == 8) {
                indexes++;
                indexed += readChunkIndex(block.content);
            } else if (block.opcode == 11) {
                readStatistics(block.content);
            } else {
                assertThat(block.opcode).isIn(3, 4);
            }
        }
        assertThat(indexes).isEqualTo(chunks);
        assertThat(indexed).isEqualTo(messages.size());
    }

    /** Returns the number of messages in its message indexes. */
    private int readChunkIndex(ByteBuffer in) {
        long first = in.getLong();
        long last = in.getLong();
        Block chunk = block(file, (int) in.getLong());
        assertThat(chunk.opcode).isEqualTo(6);
        assertThat(in.getLong()).isEqualTo(chunk.end - chunk.start);
        assertThat(chunk.content.duplicate().order(ByteOrder.LITTLE_ENDIAN).getLong())
                .isEqualTo(first);
        ByteBuffer records = records(chunk.content);
        int mapEnd = in.getInt() + in.position();
        long indexAt = chunk.end;
        int named = 0;
        while (in.position() < mapEnd) {
            int channel = in.getShort();
            assertThat(in.getLong()).isEqualTo(indexAt);
            Block index = block(file, (int) indexAt);
            assertThat(index.opcode).isEqualTo(7);
            assertThat((int) index.content.getShort()).isEqualTo(channel);
            assertThat(index.content.getInt()).isEqualTo(index.content.remaining());
            for (; index.content.hasRemaining(); named++) {
                long nanos = index.content.getLong();
                assertThat(nanos).isBetween(first, last);
                Block message = block(records, (int) index.content.getLong());
                assertThat(message.opcode).isEqualTo(5);
                assertThat((int) message.content.getShort()).isEqualTo(channel);
                message.content.getInt();
                assertThat(message.content.getLong()).isEqualTo(nanos);
            }
            indexAt = index.end;
        }
        assertThat(in.getLong()).isEqualTo(indexAt - chunk.end);
        assertThat(text(in)).isEmpty();
        assertThat(in.getLong()).isEqualTo(records.limit()).isEqualTo(in.getLong());
        return named;
    }

    private void readStatistics(ByteBuffer in) {
        assertThat(in.getLong()).isEqualTo(messages.size());
        assertThat((int) in.getShort()).isEqualTo(schemas.size());
        assertThat(in.getInt()).isEqualTo(channels.size());
        assertThat(in.getLong()).as("attachments, metadata").isZero();
        assertThat(in.getInt()).isEqualTo(chunks);
        assertThat(in.getLong()).isEqualTo(messages.isEmpty() ? 0 : messages.get(0).nanos);
        assertThat(in.getLong()).isEqualTo(messages.isEmpty() ? 0 : messages.get(messages.size() - 1).nanos);
        Map<Integer, Long> statistics = new TreeMap<>();
        assertThat(in.getInt()).isEqualTo(in.remaining());
        while (in.hasRemaining()) {
            statistics.put((int) in.getShort(), in.getLong());
        }
        assertThat(statistics).isEqualTo(counts);
    }

    private void readOffsets(long summary, long offsets, long end) {
        long expected = summary;
        for (long at = offsets; at < end; ) {
            Block block = block(file, (int) at);
            assertThat(block.opcode).isEqualTo(14);
            int opcode = block.content.get();
            assertThat(block.content.getLong()).isEqualTo(expected);
            long groupEnd = expected + block.content.getLong();
            while (expected < groupEnd) {
                Block one = block(file, (int) expected);
                assertThat(one.opcode).isEqualTo(opcode);
                expected = one.end;
            }
            at = block.end;
        }
        assertThat(expected).isEqualTo(offsets);
    }

    private static Block block(ByteBuffer in, int at) {
        int opcode = in.get(at);
        int length = (int) in.getLong(at + 1);
        ByteBuffer content = in.slice(at + 9, length).order(ByteOrder.LITTLE_ENDIAN);
        return new Block(opcode, at, content, at + 9L + length);
    }

    private static String text(ByteBuffer in) {
        byte[] bytes = new byte[in.getInt()];
        in.get(bytes);
        return new String(bytes, UTF_8);
    }

    private long crc(long from, long to) {
        CRC32 crc = new CRC32();
        crc.update(file.slice((int) from, (int) (to - from)));
        return crc.getValue();
    }

    private static long unsigned(int value) {
        return Integer.toUnsignedLong(value);
    }
}
