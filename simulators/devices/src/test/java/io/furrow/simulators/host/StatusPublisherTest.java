package io.furrow.simulators.host;

import java.util.ArrayList;
import java.util.List;

import org.junit.jupiter.api.Test;

import io.furrow.model.device.DeviceStatus;
import io.furrow.model.device.DeviceStatus.State;

import static org.assertj.core.api.Assertions.assertThat;

class StatusPublisherTest {
    private final List<String> published = new ArrayList<>();
    private final StatusPublisher statusPublisher = new StatusPublisher((key, status) -> published.add(
            status == null
                    ? key + " gone"
                    : "%s %d %s%s"
                            .formatted(
                                    key,
                                    status.sequence(),
                                    status.state().code(),
                                    status.reason() == null ? "" : ": " + status.reason())));

    @Test
    void reportsThatADeviceRunsOnlyOnceItsConnectionStands() {
        statusPublisher.begun("k", "d", running(1));
        assertThat(published).isEmpty();

        statusPublisher.up("d");

        assertThat(published).containsExactly("k 1 running");
    }

    @Test
    void reportsWhyADeviceDoesNotComeUpWhenItWasTriedOftenAndThatItDidInTheEnd() {
        statusPublisher.begun("k", "d", running(1));
        for (int attempts = 1; attempts < StatusPublisher.MAX_ATTEMPTS; attempts++) {
            statusPublisher.failed("d", attempts, "refused");
        }
        assertThat(published).isEmpty();

        statusPublisher.failed("d", StatusPublisher.MAX_ATTEMPTS, "refused");
        statusPublisher.confirmed("k", running(2));
        statusPublisher.up("d");

        assertThat(published).containsExactly("k 1 failed: refused", "k 2 failed: refused", "k 2 running");
    }

    @Test
    void goesOnUnderTheNextSequenceOnceItIsUp() {
        statusPublisher.begun("k", "d", running(1));
        statusPublisher.up("d");
        statusPublisher.confirmed("k", running(2));

        assertThat(published).containsExactly("k 1 running", "k 2 running");
    }

    @Test
    void takesNoNoticeOfTheConnectionOfADeviceThatIsGone() {
        statusPublisher.begun("k", "d", running(1));
        statusPublisher.ended("k", null);
        statusPublisher.up("d");
        statusPublisher.failed("d", 100, "refused");

        assertThat(published).containsExactly("k gone");
        assertThat(statusPublisher.keyOf("d")).isEmpty();
    }

    private static DeviceStatus running(long sequence) {
        return new DeviceStatus(sequence, State.RUNNING, null);
    }
}
