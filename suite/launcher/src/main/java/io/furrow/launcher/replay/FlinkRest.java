package io.furrow.launcher.replay;

import java.io.IOException;
import java.net.URI;
import java.net.http.HttpClient;
import java.net.http.HttpRequest;
import java.net.http.HttpRequest.BodyPublisher;
import java.net.http.HttpRequest.BodyPublishers;
import java.net.http.HttpResponse;
import java.nio.charset.StandardCharsets;
import java.nio.file.Path;
import java.time.Duration;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.UUID;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.file.FileProblem;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.text.FailureText;

/** The part of Flink's REST API that uploads a jar, runs it, lists jobs and cancels them. */
final class FlinkRest {
    private static final Duration CONNECT = Duration.ofSeconds(5);
    /** Includes planning the job. */
    private static final Duration ANSWER = Duration.ofSeconds(60);

    private static final int NOT_FOUND = 404;
    private static final int CONFLICT = 409;

    private final HttpClient http = HttpClient.newBuilder()
            .version(HttpClient.Version.HTTP_1_1)
            .connectTimeout(CONNECT)
            .build();
    private final String base;

    /** @param base as in {@code http://jobmanager:8081} */
    FlinkRest(URI base) {
        this.base = base.toString().replaceAll("/+$", "");
    }

    /** Ids by name of the jobs that have not ended; one of several with the same name. */
    Map<String, String> jobs() throws AnalyticsException {
        Map<String, String> jobs = new HashMap<>();
        for (JsonNode job : json(request("/jobs/overview").GET().build()).path("jobs")) {
            if (!List.of("FAILED", "CANCELED", "FINISHED")
                    .contains(job.path("state").asText())) {
                jobs.put(job.path("name").asText(), job.path("jid").asText());
            }
        }
        return jobs;
    }

    /** Slots that no job uses. */
    int freeSlots() throws AnalyticsException {
        return json(request("/overview").GET().build()).path("slots-available").asInt();
    }

    /** Id of the jar uploaded under a name; null if there is none. */
    String jar(String name) throws AnalyticsException {
        for (JsonNode jar : json(request("/jars").GET().build()).path("files")) {
            if (name.equals(jar.path("name").asText())) {
                return jar.path("id").asText();
            }
        }
        return null;
    }

    /** @return its id */
    String upload(Path jar, String name) throws AnalyticsException {
        String boundary = UUID.randomUUID().toString();
        String head =
                "--%s\r\nContent-Disposition: form-data; name=\"jarfile\"; filename=\"%s\"\r\nContent-Type: application/x-java-archive\r\n\r\n"
                        .formatted(boundary, name);
        try {
            BodyPublisher body = BodyPublishers.concat(
                    BodyPublishers.ofString(head, StandardCharsets.UTF_8),
                    BodyPublishers.ofFile(jar),
                    BodyPublishers.ofString("\r\n--" + boundary + "--\r\n", StandardCharsets.UTF_8));
            HttpRequest request = request("/jars/upload")
                    .header("Content-Type", "multipart/form-data; boundary=" + boundary)
                    .POST(body)
                    .build();
            String file = json(request).path("filename").asText();
            return file.substring(file.lastIndexOf('/') + 1);
        } catch (IOException e) {
            throw new AnalyticsException(jar + " cannot be read: " + FileProblem.of(e), e);
        }
    }

    /** Runs a class of an uploaded jar. */
    void run(String jar, String entryClass, List<String> arguments) throws AnalyticsException {
        ObjectNode body = JsonNodeFactory.instance.objectNode().put("entryClass", entryClass);
        arguments.forEach(body.putArray("programArgsList")::add);
        json(request("/jars/" + jar + "/run")
                .header("Content-Type", "application/json")
                .POST(BodyPublishers.ofByteArray(NgsiJson.write(body)))
                .build());
    }

    /** Cancels a job; does nothing if it has ended. */
    void cancel(String job) throws AnalyticsException {
        HttpResponse<byte[]> answer = send(request("/jobs/" + job + "?mode=cancel")
                .method("PATCH", BodyPublishers.noBody())
                .build());
        if (answer.statusCode() != NOT_FOUND && answer.statusCode() != CONFLICT) {
            read(answer);
        }
    }

    private HttpRequest.Builder request(String path) {
        return HttpRequest.newBuilder(URI.create(base + path)).timeout(ANSWER);
    }

    private JsonNode json(HttpRequest request) throws AnalyticsException {
        return read(send(request));
    }

    private HttpResponse<byte[]> send(HttpRequest request) throws AnalyticsException {
        try {
            return http.send(request, HttpResponse.BodyHandlers.ofByteArray());
        } catch (IOException e) {
            throw new AnalyticsException(
                    "Flink at %s does not answer (%s). Is it running? Check --flink-url."
                            .formatted(base, FailureText.of(e)),
                    e);
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
            throw new AnalyticsException("interrupted while waiting for Flink at " + base, e);
        }
    }

    private JsonNode read(HttpResponse<byte[]> answer) throws AnalyticsException {
        String path = answer.uri().getPath();
        if (answer.statusCode() / 100 != 2) {
            throw new AnalyticsException("Flink at %s answers %d to %s: %s"
                    .formatted(
                            base, answer.statusCode(), path, cause(new String(answer.body(), StandardCharsets.UTF_8))));
        }
        try {
            return answer.body().length == 0 ? NgsiJson.mapper().nullNode() : NgsiJson.read(answer.body());
        } catch (UnreadableException e) {
            throw new AnalyticsException(
                    "%s answers to %s what is not JSON: is it a Flink? Check --flink-url.".formatted(base, path), e);
        }
    }

    /** The cause within Flink's stack traces. */
    private static String cause(String body) {
        String response = FailureText.ofTrace(body.replace("\\n", "\n"));
        return response.length() <= 300 ? response : response.substring(0, 300) + " …";
    }
}
