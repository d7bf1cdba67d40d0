package io.furrow.connect.source;

import java.io.IOException;
import java.net.InetAddress;
import java.net.Socket;
import java.util.Map;

import org.apache.kafka.common.config.ConfigException;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class AccessTest {
    private static final String PUBLIC_URL = "http://notify.example.org:{port}/v2/notify";

    /** As an Orion posts to the URL of a subscription: with its host and port, without an origin. */
    @Test
    void hearsTheContextBrokerAtThePublicHostThoughItListensElsewhere() throws IOException {
        try (NotificationRig rig = new NotificationRig("public.url", PUBLIC_URL)) {
            assertThat(post(rig, "Host: notify.example.org:" + rig.port())).startsWith("HTTP/1.1 200 ");
            assertThat(post(rig, "Host: NOTIFY.example.org.")).startsWith("HTTP/1.1 200 ");
            assertThat(post(rig, "Host: 127.0.0.1:" + rig.port())).startsWith("HTTP/1.1 200 ");

            assertThat(rig.recordLog.taken).hasSize(3);
            assertThat(rig.ledger.foreign.sum()).isZero();
        }
    }

    @Test
    void hearsItAtTheHostsThatAreNamed() throws IOException {
        try (NotificationRig rig = new NotificationRig("allowed.hosts", "furrow, furrow.farm.svc")) {
            assertThat(post(rig, "Host: furrow:8090")).startsWith("HTTP/1.1 200 ");
            assertThat(post(rig, "Host: furrow.farm.svc:8090")).startsWith("HTTP/1.1 200 ");
            assertThat(post(rig, "Host: furrow.farm")).startsWith("HTTP/1.1 403 ");
        }
    }

    @Test
    void refusesOtherHostsAndPagesCountsThemAndSaysWhatToSet() throws IOException {
        try (var rig = new NotificationRig("public.url", PUBLIC_URL, "allowed.origins", "https://map.example.org")) {
            assertThat(post(rig, "Host: evil.example:8090"))
                    .startsWith("HTTP/1.1 403 ")
                    .endsWith(
                            "{\"error\":\"foreign-host\",\"description\":\"this server is not known as 'evil.example'; if it is,"
                                    + " name that in allowed.hosts\"}");
            assertThat(post(rig, "Host: localhost\r\nOrigin: https://evil.example"))
                    .startsWith("HTTP/1.1 403 ")
                    .endsWith(
                            "{\"error\":\"foreign-origin\",\"description\":\"pages of https://evil.example may not use this"
                                    + " server; if they may, name that in allowed.origins\"}");
            assertThat(post(rig, "Host: localhost\r\nOrigin: https://map.example.org"))
                    .startsWith("HTTP/1.1 200 ");

            assertThat(rig.ledger.foreign.sum()).isEqualTo(2);
            assertThat(rig.recordLog.taken).hasSize(1);
        }
    }

    @Test
    void showsItsHealthToProbesAndItsNumbersToThoseWhoKnowItsName() throws IOException {
        try (NotificationRig rig = new NotificationRig()) {
            assertThat(ask(rig, "GET /health HTTP/1.1\r\nHost: 10.1.2.3:8090\r\n"))
                    .startsWith("HTTP/1.1 200 ");
            assertThat(ask(rig, "GET /health HTTP/1.0\r\n")).startsWith("HTTP/1.1 200 ");
            assertThat(ask(rig, "GET /metrics HTTP/1.1\r\nHost: 10.1.2.3:8090\r\n"))
                    .startsWith("HTTP/1.1 403 ");
            assertThat(post(rig, "/health", "Host: 10.1.2.3:8090")).startsWith("HTTP/1.1 403 ");
        }
    }

    @ParameterizedTest
    @CsvSource({
        "allowed.hosts, http://furrow, is not a host",
        "allowed.hosts, furrow:8090, is not a host",
        "allowed.origins, map.example.org, is not an origin",
        "allowed.origins, *, is not an origin"
    })
    void refusesNamesThatAreNone(String option, String value, String why) {
        assertThatThrownBy(() -> new NgsiSourceConfig(Map.of("journal.dir", "/tmp/journal", option, value)))
                .isInstanceOf(ConfigException.class)
                .hasMessageContainingAll(option, "'" + value + "' " + why);
    }

    private static String post(NotificationRig rig, String headers) throws IOException {
        return post(rig, "/v2/notify", headers);
    }

    private static String post(NotificationRig rig, String path, String headers) throws IOException {
        RecordedRequest recorded = RecordedRequest.of("normalized-05");
        return ask(
                rig,
                "POST " + path + " HTTP/1.1\r\nContent-Type: application/json; charset=utf-8\r\nContent-Length: "
                        + recorded.body().getBytes(UTF_8).length + "\r\n" + headers + "\r\n",
                recorded.body());
    }

    private static String ask(NotificationRig rig, String head) throws IOException {
        return ask(rig, head, "");
    }

    private static String ask(NotificationRig rig, String head, String body) throws IOException {
        try (Socket socket = new Socket(InetAddress.getLoopbackAddress(), rig.port())) {
            socket.setSoTimeout((int) NotificationRig.TIMEOUT.toMillis());
            socket.getOutputStream().write((head + "Connection: close\r\n\r\n" + body).getBytes(UTF_8));
            socket.getOutputStream().flush();
            return new String(socket.getInputStream().readAllBytes(), UTF_8);
        }
    }
}
