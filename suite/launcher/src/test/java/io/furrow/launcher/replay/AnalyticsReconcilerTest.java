package io.furrow.launcher.replay;

import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.TreeSet;

import org.junit.jupiter.api.Test;

import io.furrow.cli.control.ReplayAnalyticsJob;

import static org.assertj.core.api.Assertions.assertThat;

class AnalyticsReconcilerTest {
    private static final String A = "data.weeding.replay.0000000a";
    private static final String B = "data.sowing.replay.0000000b";
    private static final String COLLISION_A = "collision-of-weeding.0000000a";
    private static final String PRESENCE_A = "presence-of-weeding.0000000a";

    private final Cluster cluster = new Cluster();
    private final Map<String, JobProgress> progress = new HashMap<>();
    private long now = 1_000_000;
    private AnalyticsReconciler reconciler = reconciler();

    private AnalyticsReconciler reconciler() {
        return new AnalyticsReconciler(cluster, job -> progress.get(job.name()), () -> now);
    }

    @Test
    void startsEachJobOnceWhenTheTopicIsThere() throws Exception {
        DesiredAnalytics replay = running(A, "collision", "presence");
        reconciler.reconcile(List.of(replay));
        assertThat(cluster.running).isEmpty();

        progress(0, 10);
        reconciler.reconcile(List.of(replay));
        reconciler.reconcile(List.of(replay));

        assertThat(cluster.started).containsExactly(COLLISION_A, PRESENCE_A);
    }

    @Test
    void leavesWhatRunsAfterARestart() throws Exception {
        progress(5, 10);
        cluster.running.addAll(Set.of(COLLISION_A, "collision", "collision-weeding.0000000a"));

        reconciler.reconcile(List.of(running(A, "collision")));

        assertThat(cluster.started).isEmpty();
        assertThat(cluster.running).hasSize(3);
    }

    @Test
    void endsAJobALittleAfterItHasReadAllOfAReplayThatIsOver() throws Exception {
        progress(0, 10);
        reconciler.reconcile(List.of(running(A, "collision")));
        DesiredAnalytics over = running(A, "collision").ended();

        progress(5, 10);
        reconcileAfter(0, over);
        progress(10, 10);
        reconcileAfter(20_000, over);
        reconcileAfter(11_000, over);
        assertThat(cluster.running).containsExactly(COLLISION_A);

        reconcileAfter(1_000, over);
        assertThat(cluster.running).isEmpty();
        reconcileAfter(60_000, over);
        reconcileAfter(60_000);
        assertThat(cluster.started).containsExactly(COLLISION_A);
    }

    @Test
    void endsAJobThatMakesNoProgress() throws Exception {
        progress(5, 10);
        reconciler.reconcile(List.of(running(A, "collision")));

        reconcileAfter(0);
        reconcileAfter(299_000);
        assertThat(cluster.running).containsExactly(COLLISION_A);
        reconcileAfter(1_000);

        assertThat(cluster.running).isEmpty();
        reconcileAfter(60_000);
        assertThat(cluster.started).containsExactly(COLLISION_A);
    }

    @Test
    void goesOnWithAReplayThatPlaysAgain() throws Exception {
        progress(10, 10);
        DesiredAnalytics replay = running(A, "collision");
        reconciler.reconcile(List.of(replay));
        reconcileAfter(0, replay.ended());
        reconcileAfter(11_000, replay.ended());
        reconcileAfter(1_000, replay);
        reconcileAfter(5_000, replay.ended());
        assertThat(cluster.running).containsExactly(COLLISION_A);

        reconcileAfter(12_000, replay.ended());
        assertThat(cluster.running).isEmpty();
        reconcileAfter(60_000, replay);
        assertThat(cluster.running).containsExactly(COLLISION_A);
    }

    @Test
    void runsOnAReplayThatWasOverBeforeItsJobsRan() throws Exception {
        progress(0, 10);
        reconciler.reconcile(List.of(running(A, "collision").ended()));
        assertThat(cluster.started).containsExactly(COLLISION_A);

        cluster.running.clear();
        progress(10, 10);
        reconciler = reconciler();
        reconciler.reconcile(List.of(running(A, "collision").ended()));
        assertThat(cluster.started).as("it has read all").containsExactly(COLLISION_A);
    }

    @Test
    void endsJobsOfReplaysThatAreGoneAndNoOthers() throws Exception {
        cluster.running.addAll(Set.of(COLLISION_A, "collision", "collision-weeding.0000000a"));
        progress.clear();
        reconcileAfter(0);
        assertThat(cluster.running).as("the topic may be on another Kafka").hasSize(3);

        progress(10, 10);
        reconcileAfter(0);
        reconcileAfter(JobEnding.SETTLING.toMillis());

        assertThat(cluster.running).containsExactlyInAnyOrder("collision", "collision-weeding.0000000a");
    }

    @Test
    void startsAllJobsOfAReplayOrNoneAndReportsSo() throws Exception {
        progress(0, 10);
        cluster.room = 3;
        DesiredAnalytics second = running(B, "collision", "presence");
        reconciler.reconcile(List.of(running(A, "collision", "presence"), second));

        assertThat(cluster.running).hasSize(2).allMatch(name -> name.endsWith("sowing.0000000b"));
        assertThat(reconciler.waiting()).singleElement().asString().contains(A, "it wants 2 jobs, 1 fit");

        cluster.room = 4;
        reconcileAfter(0, running(A, "collision", "presence"), second);
        assertThat(cluster.running).hasSize(4);
        assertThat(reconciler.waiting()).isEmpty();
    }

    @Test
    void triesAgainAfterAWhileWhatDidNotStart() throws Exception {
        progress(0, 10);
        cluster.refuses = true;
        DesiredAnalytics replay = running(A, "collision");
        reconciler.reconcile(List.of(replay));
        cluster.refuses = false;

        reconcileAfter(19_000, replay);
        assertThat(cluster.running).isEmpty();
        reconcileAfter(1_000, replay);
        assertThat(cluster.running).containsExactly(COLLISION_A);
    }

    private void reconcileAfter(long millis, DesiredAnalytics... desired) throws Exception {
        now += millis;
        reconciler.reconcile(List.of(desired));
    }

    /** Of all jobs. */
    private void progress(long read, long end) {
        for (String job : List.of("collision", "presence")) {
            for (String topic : List.of(A, B)) {
                progress.put(new ReplayAnalyticsJob(job, topic).name(), new JobProgress(read, end));
            }
        }
    }

    private static DesiredAnalytics running(String topic, String... jobs) {
        return new DesiredAnalytics(
                topic,
                List.of(jobs).stream()
                        .map(job -> new ReplayAnalyticsJob(job, topic))
                        .toList(),
                false);
    }

    /** Names of jobs, and nothing behind them. */
    private static final class Cluster implements AnalyticsExecutor {
        private final Set<String> running = new TreeSet<>();
        private final List<String> started = new ArrayList<>();
        private int room = 100;
        private boolean refuses;

        @Override
        public Set<String> running() {
            return Set.copyOf(running);
        }

        @Override
        public int free() {
            return room - running.size();
        }

        @Override
        public void start(ReplayAnalyticsJob job) throws AnalyticsException {
            if (refuses) {
                throw new AnalyticsException("no");
            }
            running.add(job.name());
            started.add(job.name());
        }

        @Override
        public void cancel(String name) {
            running.remove(name);
        }
    }
}
