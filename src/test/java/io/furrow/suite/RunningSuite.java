package io.furrow.suite;

import java.io.OutputStreamWriter;
import java.io.PrintWriter;
import java.net.http.HttpClient;
import java.net.http.HttpRequest;
import java.net.http.HttpResponse;
import java.nio.file.Path;

import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.launcher.process.Progress;
import io.furrow.launcher.suite.RunDirectory;
import io.furrow.launcher.suite.Suite;
import io.furrow.launcher.suite.SuiteSettings;
import io.furrow.model.ngsi.NgsiJson;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

/** A suite on free ports for a test, with queries that tests need. */
public record RunningSuite(RunDirectory directory, Suite suite) implements AutoCloseable {
    /** @param stored null for a temporary directory */
    public static RunningSuite start(Path stored) throws Exception {
        return start(stored, SuiteSettings.onFreePorts("2s"));
    }

    public static RunningSuite start(Path stored, SuiteSettings settings) throws Exception {
        RunDirectory directory = RunDirectory.open(stored);
        PrintWriter out = new PrintWriter(new OutputStreamWriter(System.out, UTF_8));
        return new RunningSuite(directory, Suite.start(settings, directory, new Progress(out)));
    }

    public Ngsi ngsi() {
        return new Ngsi(suite);
    }

    /** A response of the control plane's REST API. */
    public JsonNode get(String path) throws Exception {
        return NgsiJson.read(request("GET", path, "").body());
    }

    JsonNode post(String path, String body) throws Exception {
        return send("POST", path, body);
    }

    /** The response to a request that must be accepted. */
    JsonNode send(String method, String path, String body) throws Exception {
        HttpResponse<byte[]> response = request(method, path, body);
        JsonNode answer = NgsiJson.read(response.body());
        assertThat(response.statusCode()).as("%s %s: %s", method, path, answer).isLessThan(300);
        return answer;
    }

    public HttpResponse<byte[]> request(String method, String path, String body) throws Exception {
        HttpRequest request = HttpRequest.newBuilder(suite.control().resolve(path))
                .header("Content-Type", "application/json")
                .method(method, HttpRequest.BodyPublishers.ofString(body))
                .build();
        return HttpClient.newHttpClient().send(request, HttpResponse.BodyHandlers.ofByteArray());
    }

    void awaitReady() {
        await().until(() -> get("/ready").path("status").asText().equals("ready"));
    }

    JsonNode mission(String name) throws Exception {
        return get("/api/missions/" + name);
    }

    void awaitState(String mission, String state) {
        await("mission " + mission + " " + state)
                .until(() -> mission(mission).at("/status/state").asText().equals(state));
    }

    TopicLog topic(String name) {
        return new TopicLog(suite, name);
    }

    @Override
    public void close() {
        suite.close();
        directory.close();
    }
}
