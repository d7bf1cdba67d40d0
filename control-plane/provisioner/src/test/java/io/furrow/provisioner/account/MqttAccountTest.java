package io.furrow.provisioner.account;

import java.util.List;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

import static io.furrow.provisioner.DesiredDeviceFixture.SECRET;
import static org.assertj.core.api.Assertions.assertThat;

class MqttAccountTest {
    private static final String KEY = "/" + SECRET.apiKey("hoeing");

    private final MqttAccount device = MqttAccount.device(SECRET, "hoeing", "d");
    private final MqttAccount gateway = MqttAccount.gateway(SECRET, "hoeing");

    @Test
    void allowsADeviceItsOwnMeasuresAndCommands() {
        assertThat(device.mayWrite(KEY + "/d/attrs")).isTrue();
        assertThat(device.mayWrite("/json" + KEY + "/d/cmdexe")).isTrue();
        assertThat(device.mayRead(KEY + "/d/cmd")).isTrue();

        assertThat(device.mayWrite(KEY + "/e/attrs")).isFalse();
        assertThat(device.mayWrite(KEY + "/d/cmd")).isFalse();
        assertThat(device.mayRead(KEY + "/d/attrs")).isFalse();
    }

    @Test
    void allowsAGatewayOnlyTheDevicesOfItsMission() {
        assertThat(gateway.mayWrite(KEY + "/d/attrs")).isTrue();
        assertThat(gateway.mayRead(KEY + "/+/cmd")).isTrue();
        assertThat(gateway.mayRead(KEY + "/d/cmd")).isTrue();

        assertThat(gateway.mayWrite("/" + SECRET.apiKey("weeding") + "/d/attrs"))
                .isFalse();
    }

    @ParameterizedTest
    @ValueSource(
            strings = {
                "#", "/#", "/+/+/cmd", "/KEY/#", "/KEY/+/#",
                "/KEY/+/+", "$SYS/#", "/KEY/d/e/cmd", "/KEY/d/cmd/e", "/KEY//d/cmd"
            })
    void rejectsWiderFilters(String filter) {
        assertThat(gateway.mayRead(filter.replace("/KEY", KEY))).isFalse();
    }

    @Test
    void doesNotMatchMultiLevelWildcards() {
        MqttAccount account = new MqttAccount(device.login(), List.of(), List.of("a/+"));

        assertThat(account.mayRead("a/+")).isTrue();
        assertThat(account.mayRead("a/#")).isFalse();
    }

    @Test
    void doesNotShowThePassword() {
        assertThat(device.toString()).doesNotContain(device.login().password());
    }
}
