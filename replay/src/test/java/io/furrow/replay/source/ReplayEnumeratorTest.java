package io.furrow.replay.source;

import java.io.IOException;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.concurrent.Callable;
import java.util.function.BiConsumer;

import org.apache.flink.api.connector.source.ReaderInfo;
import org.apache.flink.api.connector.source.SourceEvent;
import org.apache.flink.api.connector.source.SplitEnumeratorContext;
import org.apache.flink.api.connector.source.SplitsAssignment;
import org.apache.flink.metrics.groups.SplitEnumeratorMetricGroup;
import org.apache.flink.metrics.groups.UnregisteredMetricsGroup;
import org.junit.jupiter.api.Test;

import io.furrow.model.control.ReplayStatus;
import io.furrow.model.control.ReplayStatus.State;
import io.furrow.replay.playback.PlaybackState;
import io.furrow.replay.source.DesiredReplays.ReplayUpdate;
import io.furrow.replay.source.DesiredReplays.ReportedStatus;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

class ReplayEnumeratorTest {
    private final Script script = new Script();
    private final Readers readers = new Readers(2);

    private ReplayEnumerator enumerator(ReplaySplit... unassigned) {
        ReplayEnumerator enumerator = new ReplayEnumerator(readers, script, new EnumeratorState(List.of(unassigned)));
        enumerator.start();
        return enumerator;
    }

    private static ReplayUpdate update(String mission, long sequence) {
        return new ReplayUpdate(
                mission + ".0a1b2c3d",
                ReplayReaderTest.desired(mission, 1, State.RUNNING, sequence).toBytes());
    }

    private static ReplaySplit split(String mission) {
        return new ReplaySplit(mission + ".0a1b2c3d", update(mission, 1).desired(), new PlaybackState(3, 77));
    }

    @Test
    void assignsReplaysEvenlyOnceAllReadersAreRegistered() {
        ReplayEnumerator enumerator = enumerator();
        script.next = List.of(update("a", 1), update("b", 1), update("c", 1), update("d", 1));
        readers.poll();
        readers.register(0, enumerator);
        assertThat(readers.assigned).isEmpty();

        readers.register(1, enumerator);

        assertThat(readers.of(0)).hasSize(2);
        assertThat(readers.of(1)).hasSize(2);
        script.next = List.of(update("a", 2));
        readers.poll();
        assertThat(readers.events).last().isEqualTo("0 a.0a1b2c3d updated");
    }

    @Test
    void reassignsReplaysOfACheckpointAndRemovesUndesiredOnes() {
        ReplayEnumerator enumerator = enumerator(split("c"));
        readers.register(0, enumerator, split("a"), split("b"), split("gone"));
        readers.register(1, enumerator);
        assertThat(readers.assigned).as("before the desired replays are read").isEmpty();

        script.next = List.of(update("a", 1), update("b", 1), update("c", 1));
        readers.poll();

        assertThat(readers.of(0)).hasSize(2);
        assertThat(readers.of(1)).hasSize(2);
        assertThat(readers.assigned).allMatch(one -> one.epoch == 3);
        assertThat(readers.events).contains("1 gone.0a1b2c3d removed").contains("0 c.0a1b2c3d updated");
        assertThat(enumerator.snapshotState(1).splits()).isEmpty();
    }

    @Test
    void keepsReturnedSplitsUntilTheirReaderRegistersAgain() {
        ReplayEnumerator enumerator = enumerator();
        readers.register(0, enumerator);
        readers.register(1, enumerator);
        script.next = List.of(update("a", 1));
        readers.poll();
        readers.registered.remove(0);

        enumerator.addSplitsBack(List.of(split("a")), 0);

        assertThat(enumerator.snapshotState(1).splits()).hasSize(1);
        readers.register(0, enumerator);
        assertThat(readers.of(0)).hasSize(2);
        assertThat(enumerator.snapshotState(2).splits()).isEmpty();
    }

    @Test
    void continuesTheEpochsOfReplaysWithoutACheckpoint() {
        ReplayStatus.Progress progress = new ReplayStatus.Progress(4, 1_000, 0, 0, 500, 0, 0, 0, 0, 0, 0, null);
        script.reported = List.of(
                new ReportedStatus("a.0a1b2c3d", new ReplayStatus(1, State.RUNNING, null, false, progress)),
                new ReportedStatus("b.0a1b2c3d", new ReplayStatus(1, State.ENDED, null, true, progress)));
        ReplayEnumerator enumerator = enumerator();
        readers.register(0, enumerator);
        readers.register(1, enumerator);

        script.next = List.of(update("a", 1), update("b", 1));
        readers.poll();

        assertThat(readers.assigned)
                .as("b is over, and its status is settled")
                .containsExactly(new Assigned(0, "a.0a1b2c3d", 5, 1_500));
        script.next = List.of(update("b", 2));
        readers.poll();
        assertThat(readers.assigned).last().isEqualTo(new Assigned(1, "b.0a1b2c3d", 5, 1_500));
    }

    @Test
    void leavesAReplayToItsReaderWhenAnotherReportsIt() {
        ReplayEnumerator enumerator = enumerator();
        script.next = List.of(update("a", 1));
        readers.poll();
        readers.register(0, enumerator);
        readers.register(1, enumerator, split("a"), split("b"));
        script.next = List.of(update("b", 1));
        readers.poll();
        int before = readers.assigned.size();
        assertThat(readers.of(0)).isNotEmpty();
        ReplaySplit moved = split(readers.of(0).get(0).replay().substring(0, 1));

        readers.register(1, enumerator, moved);

        assertThat(readers.assigned.stream().skip(before))
                .as("reader 0 plays it already")
                .noneMatch(one -> one.replay().equals(moved.replay()));
    }

    @Test
    void signalsNoMoreSplitsToAReaderThatRegistersAgain() {
        script.bounded = true;
        ReplayEnumerator enumerator = enumerator();
        script.next = List.of(update("a", 1));
        readers.poll();
        readers.register(0, enumerator);
        readers.register(1, enumerator);
        readers.events.clear();

        readers.register(0, enumerator, split("a"));

        assertThat(readers.events).contains("0 no more");
    }

    @Test
    void continuesToReadWhenTheBrokerIsBack() {
        ReplayStatus.Progress progress = new ReplayStatus.Progress(4, 1_000, 0, 0, 500, 0, 0, 0, 0, 0, 0, null);
        script.reported =
                List.of(new ReportedStatus("a.0a1b2c3d", new ReplayStatus(1, State.RUNNING, null, false, progress)));
        script.next = List.of(update("a", 1));
        script.unavailable = true;
        ReplayEnumerator enumerator = enumerator();
        readers.register(0, enumerator);
        readers.register(1, enumerator);

        script.unavailable = false;
        readers.poll();
        script.unavailable = true;
        readers.poll();
        assertThat(readers.assigned).isEmpty();
        script.unavailable = false;
        readers.poll();

        assertThat(readers.assigned).containsExactly(new Assigned(0, "a.0a1b2c3d", 5, 1_500));
    }

    @Test
    void skipsRecordsThatAreNoReplays() {
        ReplayEnumerator enumerator = enumerator();
        readers.register(0, enumerator);
        readers.register(1, enumerator);

        byte[] bytes = "x".getBytes(UTF_8);
        script.next = List.of(
                new ReplayUpdate(null, bytes),
                new ReplayUpdate("no name", bytes),
                new ReplayUpdate("a.0a1b2c3d", bytes));
        readers.poll();

        assertThat(readers.assigned).extracting(Assigned::replay).containsExactly("a.0a1b2c3d");
    }

    private static final class Script implements DesiredReplays {
        private static final long serialVersionUID = 1L;

        private transient List<ReportedStatus> reported = List.of();
        private transient List<ReplayUpdate> next = List.of();
        private transient boolean bounded;
        private transient boolean unavailable;

        @Override
        public boolean isBounded() {
            return bounded;
        }

        @Override
        public Reading open() {
            return new Reading() {
                @Override
                public List<ReportedStatus> reportedStatuses() throws IOException {
                    requireAvailable();
                    return reported;
                }

                @Override
                public List<ReplayUpdate> poll() throws IOException {
                    requireAvailable();
                    return next;
                }

                private void requireAvailable() throws IOException {
                    if (unavailable) {
                        throw new IOException("the broker does not answer");
                    }
                }

                @Override
                public boolean isCaughtUp() {
                    return true;
                }

                @Override
                public void close() {
                    // no resources
                }
            };
        }
    }

    private record Assigned(int reader, String replay, long epoch, long stamp) {}

    /** The context of the enumerator; runs asynchronous calls at once, and periodic ones also by {@link #poll}. */
    private static final class Readers implements SplitEnumeratorContext<ReplaySplit> {
        private final int parallelism;
        private final Map<Integer, ReaderInfo> registered = new HashMap<>();
        private final List<Assigned> assigned = new ArrayList<>();
        private final List<String> events = new ArrayList<>();
        private Runnable poll;

        Readers(int parallelism) {
            this.parallelism = parallelism;
        }

        void register(int reader, ReplayEnumerator enumerator, ReplaySplit... reported) {
            registered.put(reader, ReaderInfo.createReaderInfo(reader, "here", List.of(reported)));
            enumerator.addReader(reader);
        }

        void poll() {
            poll.run();
        }

        List<Assigned> of(int reader) {
            return assigned.stream().filter(one -> one.reader == reader).toList();
        }

        @Override
        public SplitEnumeratorMetricGroup metricGroup() {
            return UnregisteredMetricsGroup.createSplitEnumeratorMetricGroup();
        }

        @Override
        public void sendEventToSourceReader(int reader, SourceEvent event) {
            ReplayChangeEvent desired = (ReplayChangeEvent) event;
            events.add(reader + " " + desired.replay() + (desired.desired() == null ? " removed" : " updated"));
        }

        @Override
        public int currentParallelism() {
            return parallelism;
        }

        @Override
        public Map<Integer, ReaderInfo> registeredReaders() {
            return registered;
        }

        @Override
        public void assignSplits(SplitsAssignment<ReplaySplit> assignment) {
            assignment
                    .assignment()
                    .forEach((reader, splits) -> splits.forEach(split -> assigned.add(new Assigned(
                            reader,
                            split.replay(),
                            split.state().epoch(),
                            split.state().stamp()))));
        }

        @Override
        public void signalNoMoreSplits(int reader) {
            events.add(reader + " no more");
        }

        @Override
        public <T> void callAsync(Callable<T> callable, BiConsumer<T, Throwable> handler) {
            try {
                handler.accept(callable.call(), null);
            } catch (Exception e) {
                handler.accept(null, e);
            }
        }

        @Override
        public <T> void callAsync(
                Callable<T> callable, BiConsumer<T, Throwable> handler, long initialDelay, long period) {
            poll = () -> callAsync(callable, handler);
            poll();
        }

        @Override
        public void runInCoordinatorThread(Runnable task) {
            task.run();
        }
    }
}
