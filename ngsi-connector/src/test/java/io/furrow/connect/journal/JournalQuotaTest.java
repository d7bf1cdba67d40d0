package io.furrow.connect.journal;

import java.nio.file.Path;
import java.util.List;

import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.ValueSource;

import static org.assertj.core.api.Assertions.assertThat;

class JournalQuotaTest {
    @ParameterizedTest
    @CsvSource({"8000, 10000, true", "7999, 10000, false", "8000, 4999, false"})
    void hasRoomForASegmentWithinTheJournalsBytesAndTheDisks(long maxBytes, long usable, boolean room) {
        StubbornDisk disk = new StubbornDisk();
        disk.usable(usable);
        Path folder = Path.of(".");
        Segments segments = new Segments(List.of(Segment.created(0, folder, 4000)));
        JournalSettings settings = new JournalSettings(maxBytes, 4000, 1000, 1000);

        assertThat(new JournalQuota(settings, folder, disk, segments).isForSegment())
                .isEqualTo(room);
    }

    @ParameterizedTest
    @ValueSource(longs = {64, 100, 1000, 4096})
    void hasRoomInAnEmptyJournalForWhatItSaysIsTheMost(long mebibytes) {
        JournalSettings settings = JournalSettings.of(mebibytes * 1024 * 1024, 1000, 0);
        JournalQuota room = new JournalQuota(settings, Path.of("."), new StubbornDisk(), new Segments(List.of()));

        assertThat(room.isFor(settings.largestAppend(), 0)).isTrue();
        assertThat(room.isFor(settings.maxBytes() / 2, 0)).isFalse();
    }
}
