package io.furrow.model.control;

import org.junit.jupiter.api.Test;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

class ReplayStatusTest {
    @Test
    void readsBackAStatusWithProgress() throws Exception {
        ReplayStatus status = new ReplayStatus(
                7,
                ReplayStatus.State.ENDED,
                "mission deleted",
                false,
                new ReplayStatus.Progress(2, 30, 10, 40, 5, 3, 1_400, 17.5, 100, 9, 1, "MongoDB is away"));

        assertThat(ReplayStatus.read(status.toBytes())).isEqualTo(status);
    }

    @Test
    void readsARecordWithoutProgress() throws Exception {
        byte[] old = "{\"sequence\":7,\"state\":\"ended\"}".getBytes(UTF_8);

        assertThat(ReplayStatus.read(old)).isEqualTo(new ReplayStatus(7, ReplayStatus.State.ENDED, null, true, null));
    }

    @Test
    void omitsSettledForARunningReplay() {
        byte[] running = new ReplayStatus(7, ReplayStatus.State.RUNNING, null, false, null).toBytes();

        assertThat(new String(running, UTF_8)).isEqualTo("{\"sequence\":7,\"state\":\"running\"}");
    }
}
