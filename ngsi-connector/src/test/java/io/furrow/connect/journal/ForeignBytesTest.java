package io.furrow.connect.journal;

import java.nio.file.Files;
import java.nio.file.Path;
import java.util.Arrays;
import java.util.List;

import org.junit.jupiter.api.Test;

import static io.furrow.connect.journal.JournalTest.append;
import static io.furrow.connect.journal.JournalTest.read;
import static org.assertj.core.api.Assertions.assertThat;

/** What a journal makes of bytes that look like its own and are not. */
class ForeignBytesTest extends QuietJournal {
    private static final JournalSettings SMALL = new JournalSettings(1024 * 1024, 4 * 1024, 64 * 1024, 0);

    @Test
    void takesNoRecordAgainThatStandsInThePlaceOfAnother() throws Exception {
        try (Journal journal = open()) {
            append(journal, "aaaa", "bbbb", "cccc", "dddd");
        }
        Path segment = folder.resolve(SegmentFormat.fileName(0));
        byte[] bytes = Files.readAllBytes(segment);
        int size = SegmentFormat.RECORD_HEADER + 4;
        System.arraycopy(bytes, SegmentFormat.HEADER, bytes, SegmentFormat.HEADER + 2 * size, size);
        Files.write(segment, bytes);

        try (Journal journal = open()) {
            assertThat(read(journal.reader(0))).containsExactly("0 aaaa", "1 bbbb", "3 dddd");
            assertThat(journal.lostRecords()).isEqualTo(1);
        }
    }

    @Test
    void saysWhatIsMissingWhereALaterRecordStandsInTheirPlace() throws Exception {
        try (Journal journal = open()) {
            append(journal, "aaaa", "bbbb", "cccc", "dddd");
        }
        Path segment = folder.resolve(SegmentFormat.fileName(0));
        byte[] bytes = Files.readAllBytes(segment);
        int size = SegmentFormat.RECORD_HEADER + 4;
        System.arraycopy(bytes, SegmentFormat.HEADER + 3 * size, bytes, SegmentFormat.HEADER + size, size);
        Files.write(segment, bytes);

        try (Journal journal = open()) {
            assertThat(read(journal.reader(0))).containsExactly("0 aaaa", "3 dddd");
            assertThat(journal.lostRecords()).isEqualTo(2);
            assertThat(journal.damages()).extracting(Corruption::kind).contains(Corruption.Kind.MISSING);
        }
    }

    @Test
    void deletesAFileThatWasBeingMade() throws Exception {
        Path unfinished = Files.write(folder.resolve(SegmentFormat.fileName(7) + ".tmp"), new byte[10]);

        open().close();
        assertThat(unfinished).doesNotExist();
    }

    @Test
    void takesNoPayloadForARecordThatIsNotItsOwn() throws Exception {
        Path other = Files.createDirectory(folder.resolveSibling("0-other"));
        try (Journal journal = open()) {
            append(journal, "its own", "and one more");
        }
        byte[] foreign = Files.readAllBytes(folder.resolve(SegmentFormat.fileName(0)));
        byte[] inner = Arrays.copyOfRange(foreign, SegmentFormat.HEADER, 1000);
        try (Journal journal = Journal.open(other, SMALL).orElseThrow()) {
            journal.append(List.of(inner)).orElseThrow().join();
            append(journal, "after");
        }
        overwrite(other.resolve(SegmentFormat.fileName(0)), SegmentFormat.HEADER, (byte) 1);

        try (Journal journal = Journal.open(other, SMALL).orElseThrow()) {
            assertThat(read(journal.reader(0))).containsExactly("1 after");
        }
    }

    private Journal open() {
        return Journal.open(folder, SMALL).orElseThrow();
    }
}
