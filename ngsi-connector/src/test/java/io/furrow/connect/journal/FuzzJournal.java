package io.furrow.connect.journal;

import java.io.IOException;
import java.nio.ByteBuffer;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.Arrays;
import java.util.List;

import io.furrow.connect.journal.SegmentFormat.End;
import io.furrow.connect.journal.SegmentFormat.Header;
import io.furrow.files.Folders;

/**
 * What a fuzzer throws at the reading of journals. The first byte picks how the others become segment files: as they are,
 * behind a whole header, as records whose checksums are right, or as changes to a whole journal of three segments. Whatever it
 * is, the journal opens, reads on to an end in rising order, shows no record of the whole journal with other bytes than were
 * written, and takes a new record.
 */
public final class FuzzJournal {
    private static final int SEGMENT = 1024;
    private static final int SEGMENTS = 3;
    private static final int RECORDS = 5;
    private static final JournalSettings SETTINGS = new JournalSettings(1 << 20, SEGMENT, 1 << 20, 0);

    private FuzzJournal() {}

    /** Called by the fuzzer first: loading classes takes long on a busy machine, and no input hangs because of it. */
    public static void fuzzerInitialize() throws IOException, InterruptedException {
        fuzzerTestOneInput(new byte[] {3});
    }

    /** One journal; throws whatever is wrong. */
    public static void fuzzerTestOneInput(byte[] input) throws IOException, InterruptedException {
        if (input.length == 0) {
            return;
        }
        Path parent = Files.createTempDirectory("furrow-fuzz");
        Path folder = Files.createDirectory(parent.resolve("fuzz"));
        try {
            byte[] rest = Arrays.copyOfRange(input, 1, input.length);
            boolean changed = (input[0] & 3) == 3;
            if (changed) {
                writeChanged(folder, rest);
            } else {
                write(folder, 0, (input[0] & 3) == 0 ? rest : behindHeader(rest, (input[0] & 3) == 2));
            }
            readAll(folder, changed);
        } finally {
            Folders.delete(parent);
        }
    }

    private static void readAll(Path folder, boolean known) throws IOException, InterruptedException {
        byte[] fresh = {42};
        try (Journal journal = Journal.open(folder, SETTINGS).orElseThrow()) {
            long last = -1;
            try (JournalReader reader = journal.reader(0)) {
                List<JournalRecord> records = reader.read(1000, 1 << 20, Duration.ZERO);
                while (!records.isEmpty()) {
                    for (JournalRecord record : records) {
                        require(record.sequence() > last, "the order is not rising");
                        last = record.sequence();
                        require(
                                !known || Arrays.equals(record.payload(), payload(record.sequence())),
                                "record " + record.sequence() + " has other bytes than were written");
                    }
                    records = reader.read(1000, 1 << 20, Duration.ZERO);
                }
            }
            require(journal.end() > last, "the end is not behind the last record");
            if (last < Long.MAX_VALUE / 2) {
                journal.append(List.of(fresh)).ifPresent(durable -> durable.join());
                try (JournalReader reader = journal.reader(last + 1)) {
                    List<JournalRecord> records = reader.read(10, 1 << 20, Duration.ZERO);
                    require(
                            records.size() == 1 && Arrays.equals(records.get(0).payload(), fresh),
                            "the new record cannot be read");
                }
            }
        }
    }

    private static byte[] behindHeader(byte[] rest, boolean asRecords) {
        long salt = SegmentFormat.saltOf("fuzz");
        ByteBuffer file = ByteBuffer.allocate(SegmentFormat.HEADER + rest.length * 20 + SEGMENT);
        file.put(SegmentFormat.write(new Header(0, SEGMENT, Header.NONE, new End(0, 0)), salt));
        if (!asRecords) {
            return Arrays.copyOf(file.put(rest).array(), SegmentFormat.HEADER + rest.length);
        }
        ByteBuffer in = ByteBuffer.wrap(rest);
        while (in.remaining() >= 2) {
            byte[] payload = new byte[Math.min(in.get() & 0x3f, in.remaining() - 1)];
            long sequence = in.get();
            in.get(payload);
            ByteBuffer header = ByteBuffer.allocate(SegmentFormat.RECORD_HEADER);
            SegmentFormat.writeRecordHeader(header, salt, sequence, payload);
            file.put(header).put(payload);
        }
        return Arrays.copyOf(file.array(), file.position());
    }

    /** Each change is three bytes: which segment and the place, in the first two, and the new value; 0xff cuts it there. */
    private static void writeChanged(Path folder, byte[] changes) throws IOException {
        byte[][] files = new byte[SEGMENTS][];
        for (int i = 0; i < SEGMENTS; i++) {
            files[i] = segment(i);
        }
        for (int i = 0; i + 2 < changes.length; i += 3) {
            int which = (changes[i] & 0xff) % SEGMENTS;
            int place = ((changes[i] & 0xff) / SEGMENTS << 8 | changes[i + 1] & 0xff) % SEGMENT;
            if ((changes[i + 2] & 0xff) == 0xff) {
                files[which] = Arrays.copyOf(files[which], Math.min(place, files[which].length));
            } else if (place < files[which].length) {
                files[which][place] = changes[i + 2];
            }
        }
        for (int i = 0; i < SEGMENTS; i++) {
            write(folder, (long) i * RECORDS, files[i]);
        }
    }

    private static byte[] segment(int number) {
        long salt = SegmentFormat.saltOf("fuzz");
        long base = (long) number * RECORDS;
        long end = SegmentFormat.HEADER + RECORDS * (SegmentFormat.RECORD_HEADER + (long) payload(0).length);
        long previous = number == 0 ? Header.NONE : base - RECORDS;
        End previousEnd = number == 0 ? new End(0, 0) : new End(end, base);
        ByteBuffer file = ByteBuffer.allocate(SEGMENT);
        file.put(SegmentFormat.write(new Header(base, SEGMENT, previous, previousEnd), salt));
        for (long sequence = base; sequence < base + RECORDS; sequence++) {
            ByteBuffer header = ByteBuffer.allocate(SegmentFormat.RECORD_HEADER);
            SegmentFormat.writeRecordHeader(header, salt, sequence, payload(sequence));
            file.put(header).put(payload(sequence));
        }
        return file.array();
    }

    private static byte[] payload(long sequence) {
        byte[] payload = new byte[40];
        Arrays.fill(payload, (byte) (sequence + 1));
        return payload;
    }

    private static void write(Path folder, long base, byte[] file) throws IOException {
        Files.write(folder.resolve(SegmentFormat.fileName(base)), file);
    }

    private static void require(boolean right, String message) {
        if (!right) {
            throw new IllegalStateException(message);
        }
    }
}
