package io.furrow.control.health;

import java.util.Map;

import org.junit.jupiter.api.Test;

import io.furrow.model.device.DeviceConnection;
import io.furrow.model.device.DeviceConnection.ForeignTopic;
import io.furrow.model.device.DeviceConnection.RefusedLogin;
import io.furrow.model.device.DeviceConnection.UnreadablePayload;

import static org.assertj.core.api.Assertions.assertThat;

class SilenceCauseTest {
    private static final long START = 1_700_000_000_000L;
    private static final String AT = "2023-11-14T22:13:2";
    private static final RefusedLogin REFUSED =
            new RefusedLogin(2, START + 2000, DeviceConnection.UNKNOWN_USER, "furrow.d.m.d.1.0");
    private static final ForeignTopic FOREIGN = new ForeignTopic(3, START + 3000, "/k/e/attrs");
    private static final UnreadablePayload UNREADABLE = new UnreadablePayload(4, START + 4000, "no JSON", "{");

    @Test
    void returnsTheNewestObservation() {
        assertThat(text(null, REFUSED, null, null, null))
                .isEqualTo("its user furrow.d.m.d.1.0 does not exist or no longer, and was refused 2 times, last at "
                        + AT + "2Z");
        assertThat(text(START, REFUSED, FOREIGN, null, null))
                .isEqualTo("it published 3 times, last at " + AT + "3Z to /k/e/attrs, where it may not");
        assertThat(text(START, REFUSED, FOREIGN, UNREADABLE, null))
                .isEqualTo("4 of its messages could not be read, the last at " + AT + "4Z: no JSON");
    }

    @Test
    void ignoresObservationsBeforeTheLastReport() {
        assertThat(text(START + 2500, REFUSED, null, null, START)).startsWith("it connected at " + AT + "2Z");
        assertThat(text(START, REFUSED, FOREIGN, UNREADABLE, START + 5000)).isEmpty();
    }

    @Test
    void reportsADeviceThatNeverConnectedOrSendsNothing() {
        assertThat(text(null, null, null, null, null))
                .isEqualTo("it has not connected to the MQTT broker since " + AT + "0Z");
        assertThat(text(START + 1000, null, null, null, START))
                .isEqualTo("it connected at " + AT + "1Z and has sent nothing since");
    }

    @Test
    void reportsNothingIfLoginsAreNotObserved() {
        assertThat(SilenceCause.of(new DeviceConnection(null, null, null, null, null, true), null))
                .isEmpty();
    }

    @Test
    void reportsAMissingRegistration() {
        assertThat(SilenceCause.of(new DeviceConnection(START, START, REFUSED, null, null, false), null))
                .contains(new SilenceCause("not-registered", "the IoT Agent does not know it", 0, Map.of()));
    }

    @Test
    void usesTheSingularForOneEvent() {
        RefusedLogin refused = new RefusedLogin(1, START + 2000, DeviceConnection.WRONG_PASSWORD, "u");
        assertThat(text(null, refused, null, null, null)).isEqualTo("its password was refused once, at " + AT + "2Z");
        assertThat(text(START, null, new ForeignTopic(1, START + 3000, "/k/e/attrs"), null, null))
                .isEqualTo("it published once, at " + AT + "3Z to /k/e/attrs, where it may not");
        assertThat(text(START, null, null, new UnreadablePayload(1, START + 4000, "no JSON", "{"), null))
                .isEqualTo("1 of its messages could not be read, at " + AT + "4Z: no JSON");
    }

    @Test
    void findsTheBestReasonForADeviceThatHasNotReportedYet() {
        assertThat(unreported(null, null)).isEqualTo("it has not reported yet");
        assertThat(unreported(null, "not provisioned: why")).isEqualTo("not provisioned: why");
        assertThat(unreported(connection(null, false), "not provisioned: why")).isEqualTo("not provisioned: why");
        assertThat(unreported(connection(null, true), "not provisioned: why")).startsWith("it has not connected");
        assertThat(unreported(connection(START + 1000, true), null)).startsWith("it connected at " + AT + "1Z");
        assertThat(unreported(connection(START - 1, true), null))
                .as("sent to an earlier run")
                .isEqualTo("it has not reported yet");
    }

    private static DeviceConnection connection(Long loggedIn, boolean registered) {
        return new DeviceConnection(START, loggedIn, null, null, null, registered);
    }

    private static String unreported(DeviceConnection connection, String failure) {
        return SilenceCause.ofUnheard(connection, failure, START).text();
    }

    private static String text(
            Long loggedIn, RefusedLogin refused, ForeignTopic foreign, UnreadablePayload unreadable, Long heard) {
        return SilenceCause.of(new DeviceConnection(START, loggedIn, refused, foreign, unreadable, true), heard)
                .map(SilenceCause::text)
                .orElse("");
    }
}
