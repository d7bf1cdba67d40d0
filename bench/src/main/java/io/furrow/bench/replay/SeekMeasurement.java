package io.furrow.bench.replay;

import java.util.Arrays;
import java.util.List;
import java.util.Optional;
import java.util.Set;
import java.util.concurrent.TimeUnit;
import java.util.function.Consumer;

import io.furrow.bench.frame.Figures;
import io.furrow.mission.Cursor;
import io.furrow.mission.EventPage;
import io.furrow.mission.PageLimits;
import io.furrow.mission.Recording;
import io.furrow.mission.RecordingException;
import io.furrow.mission.RecordingExtent;
import io.furrow.mission.StoredEvent;
import io.furrow.mission.mongo.MongoAccess;
import io.furrow.mission.mongo.MongoRecordings;

/**
 * Measures the reads for a seek in a stored mission: the states before a point and the first page after it; beside it, the states by a
 * scan.
 */
final class SeekMeasurement {
    private static final int PER_SECOND = 100;
    private static final int[] PERCENT = {10, 50, 90};

    private final String mongo;
    private final StoredMission mission;
    private final int turns;
    private final Consumer<String> progress;

    /** @param turns measured ones, after one of warm-up */
    SeekMeasurement(String mongo, int events, int turns, Consumer<String> progress) {
        this.mongo = mongo;
        this.mission = new StoredMission("seek", events, PER_SECOND, 1);
        this.turns = turns;
        this.progress = progress;
    }

    /** @return whether both find the same states */
    boolean run(Consumer<Figures> out) throws RecordingException {
        progress.accept("%,d events into MongoDB".formatted(mission.events()));
        mission.store(mongo);
        Figures figures = new Figures(
                "seek in a mission of %,d events, ms, medians of %d turns".formatted(mission.events(), turns));
        boolean same = true;
        try (Recording recording = new MongoRecordings(mongo, MongoAccess.DATABASE)
                .open(mission.name())
                .orElseThrow()) {
            RecordingExtent recordingExtent = recording.span().orElseThrow();
            for (int percent : PERCENT) {
                long point =
                        recordingExtent.first() + (recordingExtent.last() - recordingExtent.first()) * percent / 100;
                same &= measure(figures, recording, percent, point);
            }
        }
        out.accept(figures);
        return same;
    }

    private boolean measure(Figures figures, Recording recording, int percent, long point) throws RecordingException {
        double[] seeks = new double[turns];
        double[] scans = new double[turns];
        boolean same = true;
        for (int turn = -1; turn < turns; turn++) {
            long began = System.nanoTime();
            List<StoredEvent> known = recording.stateBefore(point, Set.of(), PageLimits.DEFAULT);
            recording.read(Cursor.before(point), PageLimits.DEFAULT);
            long sought = System.nanoTime();
            List<StoredEvent> scanned = new Scanned(recording).stateBefore(point, Set.of(), PageLimits.DEFAULT);
            long end = System.nanoTime();
            same &= known.equals(scanned);
            if (turn >= 0) {
                seeks[turn] = millis(sought - began);
                scans[turn] = millis(end - sought);
            }
        }
        figures.add(
                "to %",
                percent, "seek", Figures.median(Arrays.stream(seeks)), "scan", Figures.median(Arrays.stream(scans)));
        return same;
    }

    private static double millis(long nanos) {
        return nanos / (double) TimeUnit.MILLISECONDS.toNanos(1);
    }

    /** A recording whose states are found by a scan from its beginning. */
    private record Scanned(Recording recording) implements Recording {
        @Override
        public Optional<RecordingExtent> span() throws RecordingException {
            return recording.span();
        }

        @Override
        public EventPage read(Cursor after, PageLimits limits) throws RecordingException {
            return recording.read(after, limits);
        }

        @Override
        public void close() {
            recording.close();
        }
    }
}
