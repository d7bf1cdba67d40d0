package io.furrow.soak;

import java.io.IOException;
import java.net.URI;
import java.net.http.HttpClient;
import java.net.http.HttpRequest;
import java.net.http.HttpResponse;
import java.util.ArrayList;
import java.util.List;

import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;

/** Checks running jobs of a Flink cluster over REST: state, failures, effective options, names of vertices. */
public final class ClusterJobs {
    private final HttpClient http = HttpClient.newHttpClient();
    private final String root;
    private final List<String> faults = new ArrayList<>();

    private ClusterJobs(String root) {
        this.root = root;
    }

    /** Arguments: root of the REST API, job ids. The exit code is 0 if there are no faults. */
    public static void main(String... args) throws IOException, InterruptedException, UnreadableException {
        ClusterJobs jobs = new ClusterJobs(args[0]);
        for (String id : List.of(args).subList(1, args.length)) {
            jobs.show(id);
        }
        jobs.faults.forEach(fault -> System.out.println("    " + fault));
        System.exit(jobs.faults.isEmpty() ? 0 : 1);
    }

    private void show(String id) throws IOException, InterruptedException, UnreadableException {
        JsonNode job = get("/jobs/" + id);
        String name = job.path("name").asText();
        System.out.println(name + " is " + job.path("state").asText());
        expect(job.path("state").asText().equals("RUNNING"), name + " is not running");

        JsonNode options = get("/jobs/" + id + "/config").at("/execution-config/user-config");
        System.out.println("    options: " + NgsiJson.mapper().writeValueAsString(options));
        expect(options.has("--kafka"), name + " does not show its options");

        for (JsonNode vertex : job.path("vertices")) {
            String vertexName = vertex.path("name").asText();
            System.out.println("    " + vertex.path("parallelism").asInt() + " × " + vertexName);
            expect(isNamed(vertexName), name + " has a vertex without a name of its own: " + vertexName);
        }
        JsonNode failures = get("/jobs/" + id + "/exceptions").at("/exceptionHistory/entries");
        expect(
                failures.isEmpty(),
                name + " failed: " + failures.at("/0/stacktrace").asText());
    }

    /** Flink names an operator without a name by its kind, for instance {@code Map}. */
    private static boolean isNamed(String vertex) {
        for (String operator : vertex.split(" -> |[(), ]{2,}")) {
            if (operator.isBlank() || !operator.contains(" ")) {
                return false;
            }
        }
        return true;
    }

    private void expect(boolean met, String fault) {
        if (!met) {
            faults.add(fault);
        }
    }

    private JsonNode get(String path) throws IOException, InterruptedException, UnreadableException {
        HttpRequest request = HttpRequest.newBuilder(URI.create(root + path)).build();
        HttpResponse<byte[]> answer = http.send(request, HttpResponse.BodyHandlers.ofByteArray());
        if (answer.statusCode() != 200) {
            throw new IOException(path + " answers " + answer.statusCode());
        }
        return NgsiJson.read(answer.body());
    }
}
