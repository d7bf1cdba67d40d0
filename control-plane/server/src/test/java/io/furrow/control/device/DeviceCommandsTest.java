package io.furrow.control.device;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.TextNode;
import com.sun.net.httpserver.HttpExchange;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.ValueSource;

import io.furrow.model.event.FiwareScope;
import io.furrow.model.file.AccessToken;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.stub.StubServer;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.catchThrowable;

class DeviceCommandsTest {
    private final List<String> received = new ArrayList<>();
    private int status = 204;
    private String answer = "";
    /** Whether entities of several types have each id. */
    private boolean ambiguous;

    private volatile String authorization;

    @AutoClose
    private final StubServer broker = new StubServer(this::report);

    @Test
    void updatesTheAttributeOfTheCommand() throws Exception {
        commands().send("urn:ngsi-ld:Thermometer:m-1", "Thermometer", "restart", "now");

        assertThat(received)
                .containsExactly(
                        "PATCH /v2/entities/urn%3Angsi-ld%3AThermometer%3Am-1/attrs?type=Thermometer farm /north"
                                + " {\"restart\":{\"type\":\"command\",\"value\":\"now\"}}");
    }

    @ParameterizedTest
    @ValueSource(
            strings = {"3", "2.50", "840380235174088834", "true", "false", "null", "\"007\"", "{\"l\":[1,2.5]}", "[]"})
    void preservesTheTypeOfAValue(String value) throws Exception {
        JsonNode json = NgsiJson.read(value.getBytes(UTF_8));

        commands()
                .send(new DeviceCommands.Order("t1", "Thermometer", "on", json))
                .join();

        assertThat(received)
                .singleElement()
                .asString()
                .endsWith("{\"on\":{\"type\":\"command\",\"value\":" + value + "}}");
    }

    /** A retry helps only if the context broker, or a proxy in front of it, is unavailable. */
    @ParameterizedTest
    @CsvSource(
            quoteCharacter = '`',
            value = {
                "400,{\"error\":\"BadRequest\"},400",
                "404,{\"error\":\"NotFound\"},404",
                "404,{\"error\":\"NonExistingTenant\"},404",
                "409,{\"error\":\"TooManyResults\"},409",
                "422,{\"error\":\"Unprocessable\"},422",
                "401,{\"error\":\"invalid_token\"},",
                "404,,",
                "404,<html>nginx</html>,",
                "404,{\"message\":\"no Route matched\"},",
                "404,{\"error\":\"Not Found\"},",
                "400,{\"message\":\"bad header\"},",
                "400,`{\"error\":\"Bad Request\",\"path\":\"/v2\"}`,",
                "409,,",
                "200,<html>log in</html>,",
                "503,{\"error\":\"busy\"},"
            })
    void distinguishesRejectionsFromOutages(int answered, String body, Integer rejected) {
        status = answered;
        answer = body == null ? "" : body;

        Throwable failure = catchThrowable(() -> commands().send("t1", "Thermometer", "on", "a=b"));

        assertThat(failure).isInstanceOf(IOException.class);
        assertThat(failure instanceof RejectedCommandException existing ? existing.status() : null)
                .isEqualTo(rejected);
    }

    @Test
    void sendsACommandToARobotInItsAttributeCmd() throws Exception {
        commands().send("urn:ngsi-ld:Robot:m-1", "Robot", "Stop", "");

        commands().send("urn:ngsi-ld:Robot:m-1", "ROBOT", "Stop", "");

        assertThat(received)
                .hasSize(2)
                .containsOnly("POST /v2/entities/urn%3Angsi-ld%3ARobot%3Am-1/attrs?options=forcedUpdate farm /north"
                        + " {\"cmd\":{\"type\":\"String\",\"value\":\"Stop\"},"
                        + "\"cmd_status\":{\"type\":\"commandStatus\",\"value\":\"PENDING\"}}");
    }

    /** The desired type of a robot may differ from the reported one, so its type is named only if necessary. */
    @Test
    void namesTheTypeOfARobotIfItsIdIsAmbiguous() throws Exception {
        ambiguous = true;

        commands().send("r1", "ROBOT", "Stop", "");
        commands()
                .send(new DeviceCommands.Order("r1", "ROBOT", "Stop", TextNode.valueOf("")))
                .join();

        assertThat(received).hasSize(4);
        for (int first : new int[] {0, 2}) {
            assertThat(received.get(first)).contains("/attrs?options=forcedUpdate farm");
            assertThat(received.get(first + 1)).contains("/attrs?options=forcedUpdate&type=ROBOT farm");
        }
    }

    @Test
    void sendsTheTokenOfTheFile(@TempDir Path directory) throws Exception {
        Path file = Files.writeString(directory.resolve("token"), "Bearer s3cret\n");

        commands(AccessToken.of(file, "Authorization", message -> {})).send("urn:x", "Thermometer", "on", "");

        assertThat(authorization).isEqualTo("Bearer s3cret");
    }

    @Test
    void reportsARejection() {
        status = 422;
        answer = "{\"error\":\"Unprocessable\",\"description\":\"do not exist: urn:x/Thermometer - [ blink ]\"}";

        assertThatThrownBy(() -> commands().send("urn:x", "Thermometer", "blink", ""))
                .isInstanceOf(IOException.class)
                .hasMessageContaining(
                        "rejected 'blink' for urn:x with 422: do not exist: urn:x/Thermometer - [ blink ]");
    }

    @Test
    void explainsThatADeviceAcceptsCommandsAfterItsFirstReport() {
        status = 404;
        answer = "{\"error\":\"NotFound\",\"description\":\"The requested entity has not been found\"}";

        assertThatThrownBy(() -> commands().send("urn:x", "Thermometer", "on", ""))
                .isInstanceOf(IOException.class)
                .hasMessageContainingAll("has no entity urn:x of type Thermometer", "once it has reported");
    }

    @Test
    void reportsAnUnavailableContextBroker() {
        DeviceCommands commands = commands();
        broker.close();

        assertThatThrownBy(() -> commands.send("urn:x", "Thermometer", "on", ""))
                .isInstanceOf(IOException.class)
                .hasMessageContaining("does not respond (connection refused)");
    }

    private DeviceCommands commands() {
        return commands(AccessToken.NONE);
    }

    private DeviceCommands commands(AccessToken token) {
        return new DeviceCommands(broker.uri("/"), new FiwareScope("farm", "/north"), token);
    }

    private void report(HttpExchange exchange) throws IOException {
        authorization = exchange.getRequestHeaders().getFirst("Authorization");
        received.add("%s %s %s %s %s"
                .formatted(
                        exchange.getRequestMethod(),
                        exchange.getRequestURI(),
                        exchange.getRequestHeaders().getFirst("Fiware-Service"),
                        exchange.getRequestHeaders().getFirst("Fiware-Servicepath"),
                        new String(exchange.getRequestBody().readAllBytes(), UTF_8)));
        boolean rejected = ambiguous && !exchange.getRequestURI().getQuery().contains("type=");
        StubServer.answer(exchange, rejected ? 409 : status, rejected ? "{\"error\":\"TooManyResults\"}" : answer);
    }
}
