package io.furrow.simulators.host;

import java.util.ArrayList;
import java.util.List;

import org.junit.jupiter.api.Test;

import io.furrow.model.device.DeviceStatus;
import io.furrow.model.device.DeviceStatus.State;

import static org.assertj.core.api.Assertions.assertThat;

class StatusPublisherTest {
    private final List<String> said = new ArrayList<>();
    private final StatusPublisher board = new StatusPublisher((key, status) -> said.add(
            status == null
                    ? key + " gone"
                    : "%s %d %s%s"
                            .formatted(
                                    key,
                                    status.sequence(),
                                    status.state().code(),
                                    status.reason() == null ? "" : ": " + status.reason())));

    @Test
    void saysThatADeviceRunsOnlyOnceItsConnectionStands() {
        board.begun("k", "d", running(1));
        assertThat(said).isEmpty();

        board.up("d");

        assertThat(said).containsExactly("k 1 running");
    }

    @Test
    void saysWhyADeviceDoesNotComeUpWhenItWasTriedOftenAndThatItDidInTheEnd() {
        board.begun("k", "d", running(1));
        for (int attempts = 1; attempts < StatusPublisher.MAX_ATTEMPTS; attempts++) {
            board.failed("d", attempts, "refused");
        }
        assertThat(said).isEmpty();

        board.failed("d", StatusPublisher.MAX_ATTEMPTS, "refused");
        board.confirmed("k", running(2));
        board.up("d");

        assertThat(said).containsExactly("k 1 failed: refused", "k 2 failed: refused", "k 2 running");
    }

    @Test
    void goesOnUnderTheNextSequenceOnceItIsUp() {
        board.begun("k", "d", running(1));
        board.up("d");
        board.confirmed("k", running(2));

        assertThat(said).containsExactly("k 1 running", "k 2 running");
    }

    @Test
    void takesNoNoticeOfTheConnectionOfADeviceThatIsGone() {
        board.begun("k", "d", running(1));
        board.ended("k", null);
        board.up("d");
        board.failed("d", 100, "refused");

        assertThat(said).containsExactly("k gone");
        assertThat(board.keyOf("d")).isEmpty();
    }

    private static DeviceStatus running(long sequence) {
        return new DeviceStatus(sequence, State.RUNNING, null);
    }
}
