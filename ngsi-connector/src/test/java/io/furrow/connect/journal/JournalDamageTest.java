package io.furrow.connect.journal;

import java.io.IOException;
import java.io.RandomAccessFile;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Random;
import java.util.stream.IntStream;

import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;

import static io.furrow.connect.journal.JournalTest.append;
import static io.furrow.connect.journal.JournalTest.read;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.tuple;

/** What a journal makes of files that changed while it was closed. */
class JournalDamageTest extends QuietJournal {
    private static final JournalSettings SMALL = new JournalSettings(1024 * 1024, 4 * 1024, 64 * 1024, 0);
    private static final int RECORDS = 60;

    @BeforeEach
    void writeARecordForEachNumber() throws Exception {
        try (Journal journal = open()) {
            for (int i = 0; i < RECORDS; i++) {
                append(journal, text(i));
            }
        }
    }

    private static String text(int number) {
        return "record " + number + " " + "x".repeat(number * 37 % 400);
    }

    private static List<String> expected(int from, int to) {
        return IntStream.range(from, to).mapToObj(i -> i + " " + text(i)).toList();
    }

    @Test
    void missesTheLastRecordOnlyWhereverTheFileEndsWithinIt() throws Exception {
        Path last = segments().get(segments().size() - 1);
        byte[] whole = Files.readAllBytes(last);
        int end = endOfRecords(last);
        int begin = end - SegmentFormat.sizeOf(text(RECORDS - 1).getBytes());

        for (int length = begin; length < end; length++) {
            Files.write(last, Arrays.copyOf(whole, length));
            try (Journal journal = open()) {
                assertThat(read(journal.reader(0))).as("cut at %d", length).isEqualTo(expected(0, RECORDS - 1));
                assertThat(journal.damages())
                        .as("cut at %d", length)
                        .extracting(Corruption::kind)
                        .contains(Corruption.Kind.TRUNCATED);
            }
        }
    }

    @Test
    void dropsAnAppendThatDidNotReachTheDiskWhole() throws Exception {
        Path last = segments().get(segments().size() - 1);
        byte[] whole = Files.readAllBytes(last);
        int end = endOfRecords(last);
        int begin = end - SegmentFormat.sizeOf(text(RECORDS - 1).getBytes());

        for (int written = begin; written < end; written++) {
            byte[] torn = whole.clone();
            Arrays.fill(torn, written, end, (byte) 0);
            Files.write(last, torn);
            try (Journal journal = open()) {
                assertThat(read(journal.reader(0))).as("written to %d", written).isEqualTo(expected(0, RECORDS - 1));
                boolean anything = written > begin && !onlyZeros(torn, begin, end);
                assertThat(journal.damages().isEmpty()).isEqualTo(!anything);
                assertThat(journal.lostRecords()).isZero();
            }
        }
    }

    @Test
    void appendsBehindATornTailAndForgetsIt() throws Exception {
        Path last = segments().get(segments().size() - 1);
        overwrite(last, endOfRecords(last) - 5, (byte) 0x55);

        try (Journal journal = open()) {
            assertThat(journal.end()).isEqualTo(RECORDS - 1);
            append(journal, "instead");
        }
        try (Journal journal = open()) {
            List<String> all = new ArrayList<>(expected(0, RECORDS - 1));
            all.add(RECORDS - 1 + " instead");
            assertThat(read(journal.reader(0))).isEqualTo(all);
            assertThat(journal.damages()).isEmpty();
        }
    }

    @Test
    void losesNothingElseAndSaysSoWhicheverBitFlips() throws Exception {
        long seed = System.nanoTime();
        Random random = new Random(seed);
        List<Path> segments = segments();
        Map<Path, Integer> ends = new HashMap<>();
        for (Path segment : segments) {
            ends.put(segment, endOfRecords(segment));
        }
        for (int round = 0; round < 1000; round++) {
            Path segment = segments.get(random.nextInt(segments.size()));
            int at = random.nextInt(random.nextInt(10) == 0 ? (int) Files.size(segment) : ends.get(segment));
            int bit = random.nextInt(8);
            String where = "seed %d round %d: bit %d of byte %d in %s".formatted(seed, round, bit, at, segment);
            flip(segment, at, bit);
            assertAtMostOneIsMissingAndItIsSaid(where);
            flip(segment, at, bit);
        }
        assertThat(readAll()).isEqualTo(expected(0, RECORDS));
    }

    private void assertAtMostOneIsMissingAndItIsSaid(String where) throws Exception {
        try (Journal journal = open()) {
            JournalReader reader = journal.reader(0);
            List<String> found = read(reader);
            List<String> missing = new ArrayList<>(expected(0, RECORDS));
            assertThat(missing).as(where).containsAll(found);
            missing.removeAll(found);
            assertThat(found).as(where).isSortedAccordingTo((a, b) -> Integer.compare(number(a), number(b)));
            assertThat(missing).as(where).hasSizeLessThanOrEqualTo(1);
            if (!missing.isEmpty()) {
                assertThat(journal.damages()).as(where).isNotEmpty();
                boolean last = number(missing.get(0)) == RECORDS - 1;
                assertThat(reader.lost()).as(where).isEqualTo(last ? 0 : 1);
            }
        }
    }

    @Test
    void goesOnBehindALargeHole() throws Exception {
        Path third = segments().get(2);
        try (RandomAccessFile file = new RandomAccessFile(third.toFile(), "rw")) {
            file.seek(1000);
            file.write(new byte[1500]);
        }
        try (Journal journal = open()) {
            JournalReader reader = journal.reader(0);
            List<String> found = read(reader);
            assertThat(expected(0, RECORDS)).containsAll(found);
            assertThat(reader.lost()).isEqualTo(RECORDS - found.size()).isBetween(3L, 30L);
            assertThat(journal.lostRecords()).isEqualTo(reader.lost());
            assertThat(journal.lostBytes()).isGreaterThanOrEqualTo(1500);
            assertThat(journal.damages()).extracting(Corruption::kind).containsExactly(Corruption.Kind.CORRUPT);
        }
    }

    @Test
    void saysThatAFileIsGone() throws Exception {
        List<Path> segments = segments();
        long from =
                SegmentFormat.baseOf(segments.get(1).getFileName().toString()).orElseThrow();
        long to = SegmentFormat.baseOf(segments.get(2).getFileName().toString()).orElseThrow();
        Files.delete(segments.get(1));

        try (Journal journal = open()) {
            List<String> all = new ArrayList<>(expected(0, (int) from));
            all.addAll(expected((int) to, RECORDS));
            assertThat(read(journal.reader(0))).isEqualTo(all);
            assertThat(journal.damages()).singleElement().satisfies(damage -> {
                assertThat(damage.kind()).isEqualTo(Corruption.Kind.MISSING);
                assertThat(damage.sequence()).isEqualTo(from);
                assertThat(damage.records()).isEqualTo(to - from);
            });
        }
    }

    @Test
    void saysThatAFileInTheMiddleWasCut() throws Exception {
        Path second = segments().get(1);
        try (RandomAccessFile file = new RandomAccessFile(second.toFile(), "rw")) {
            file.setLength(1500);
        }
        try (Journal journal = open()) {
            JournalReader reader = journal.reader(0);
            List<String> found = read(reader);
            assertThat(reader.lost()).isEqualTo(RECORDS - found.size()).isPositive();
            assertThat(journal.damages()).extracting(Corruption::kind).contains(Corruption.Kind.TRUNCATED);
        }
    }

    @Test
    void saysThatAHeaderIsDamagedAndReadsTheRecordsBehindIt() throws Exception {
        Path second = segments().get(1);
        flip(second, 20, 3);

        try (Journal journal = open()) {
            assertThat(read(journal.reader(0))).isEqualTo(expected(0, RECORDS));
            assertThat(journal.damages())
                    .extracting(Corruption::kind, Corruption::records)
                    .contains(tuple(Corruption.Kind.CORRUPT, 0L));
        }
    }

    private List<String> readAll() throws Exception {
        try (Journal journal = open()) {
            return read(journal.reader(0));
        }
    }

    private static int number(String found) {
        return Integer.parseInt(found.substring(0, found.indexOf(' ')));
    }

    private static void flip(Path file, long at, int bit) throws IOException {
        try (RandomAccessFile bytes = new RandomAccessFile(file.toFile(), "rw")) {
            bytes.seek(at);
            int was = bytes.read();
            bytes.seek(at);
            bytes.write(was ^ 1 << bit);
        }
    }

    private static boolean onlyZeros(byte[] bytes, int from, int to) {
        for (int i = from; i < to; i++) {
            if (bytes[i] != 0) {
                return false;
            }
        }
        return true;
    }

    /** Every payload ends with a byte that is not zero. */
    private static int endOfRecords(Path segment) throws IOException {
        byte[] bytes = Files.readAllBytes(segment);
        int end = bytes.length;
        while (bytes[end - 1] == 0) {
            end--;
        }
        return end;
    }

    private Journal open() {
        return Journal.open(folder, SMALL).orElseThrow();
    }
}
