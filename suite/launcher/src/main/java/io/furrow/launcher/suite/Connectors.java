package io.furrow.launcher.suite;

import java.io.UncheckedIOException;
import java.net.ConnectException;
import java.net.URI;
import java.nio.file.Path;
import java.time.Duration;
import java.time.Instant;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Properties;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.cli.option.CommandException;
import io.furrow.http.AllowedNames;
import io.furrow.launcher.process.RestClient;
import io.furrow.launcher.process.Sleep;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.text.Counts;
import io.furrow.model.topic.Topics;

/** Creates the two NGSI connectors in a Connect cluster through its REST API. */
public final class Connectors {
    /** The topic of results that the context broker refused. */
    static final String DEAD_RESULTS = Topics.dead("ngsi-sink");

    private static final int MAX_RECORD_BYTES = 16 * 1024 * 1024;
    private static final Duration TIMEOUT = Duration.ofSeconds(60);
    /** Records within this time form one batch for all readers, which saves most requests and wake-ups. */
    private static final String LINGER_MS = "25";
    /** A worker's producer has one request in flight; with Kafka's default of 16 kB it holds a single large record per partition. */
    private static final String BATCH_BYTES = "262144";

    private static final Duration POLL_INTERVAL = Duration.ofMillis(100);

    private final RestClient rest = new RestClient();
    private final URI connect;
    private final URI health;
    private final SuiteSettings.Fiware fiware;

    /** @param health page of the source */
    Connectors(URI connect, URI health, SuiteSettings.Fiware fiware) {
        this.connect = connect;
        this.health = health;
        this.fiware = fiware;
    }

    /** For other connectors. */
    public Connectors(URI connect) {
        this(connect, null, null);
    }

    /**
     * Settings of the source.
     *
     * @param journal folder for notifications that Kafka does not have yet
     * @param allowed further hosts and origins
     * @param kafka settings of a Kafka client that checks whether Kafka still has acknowledged records
     */
    record Source(int port, Path journal, AllowedNames allowed, Properties kafka) {}

    /**
     * Creates or updates the source; returns when it listens for notifications and has subscribed to every change.
     *
     * @throws CommandException if the context broker is unavailable or refuses
     */
    void source(Source source, URI contextBroker) {
        FiwareScope scope = fiware.scope();
        SuiteSettings.Listening listening = fiware.listening();
        Map<String, String> settings = toBroker(contextBroker);
        settings.put("connector.class", "io.furrow.connect.source.NgsiSourceConnector");
        settings.put("tasks.max", "1");
        settings.put("producer.override.linger.ms", LINGER_MS);
        settings.put("producer.override.batch.size", BATCH_BYTES);
        settings.put("listen.port", Integer.toString(source.port()));
        settings.put("journal.dir", source.journal().toAbsolutePath().toString());
        settings.put("allowed.hosts", String.join(",", source.allowed().hosts()));
        settings.put("allowed.origins", String.join(",", source.allowed().origins()));
        settings.put("subscription.tenants", scope.service().isEmpty() ? "-" : scope.service());
        source.kafka()
                .stringPropertyNames()
                .forEach(name ->
                        settings.put("admin.override." + name, source.kafka().getProperty(name)));
        settings.put("listen.host", listening.host());
        settings.put("subscription.servicepaths", scope.servicePath().replaceFirst("/$", "") + "/#");
        if (listening.publicUrl() != null) {
            settings.put("public.url", listening.publicUrl().toString());
        }
        if (listening.secret() != null) {
            settings.put("secret.file", listening.secret().toAbsolutePath().toString());
        }
        put("ngsi-source", settings);
        awaitSubscribed(contextBroker);
    }

    private Map<String, String> toBroker(URI contextBroker) {
        Map<String, String> settings = new HashMap<>(Map.of("context.broker.url", contextBroker.toString()));
        if (fiware.tokenFile() != null) {
            settings.put(
                    "context.broker.auth.token.file",
                    fiware.tokenFile().toAbsolutePath().toString());
            if (fiware.tokenHeader() != null) {
                settings.put("context.broker.auth.header", fiware.tokenHeader());
            }
        }
        return settings;
    }

    /** A sentence if the context broker reports that its notifications do not arrive. */
    Optional<String> undelivered() {
        JsonNode seen;
        try {
            seen = check(health);
        } catch (UncheckedIOException e) { // of a source that starts again
            return Optional.empty();
        }
        for (JsonNode subscription : seen.path("subscriptions")) {
            long failures = subscription.path("failsInARow").asLong();
            if (failures > 0) {
                return Optional.of(
                        "The context broker could not deliver its last %s to %s. Check that it reaches this machine there, and --listen, --public-url and firewalls."
                                .formatted(
                                        Counts.of(failures, "notification"),
                                        subscription.path("url").asText()));
            }
        }
        return Optional.empty();
    }

    private void awaitSubscribed(URI contextBroker) {
        Instant end = Instant.now().plus(TIMEOUT);
        while (Instant.now().isBefore(end)) {
            JsonNode seen = check(health);
            if (seen.path("subscriptionsInSync").asInt() > 0) {
                return;
            }
            if (seen.path("subscriptionsOutOfSync").asInt() > 0) {
                throw new CommandException("The context broker at %s cannot be subscribed to: %s"
                        .formatted(
                                contextBroker,
                                seen.at("/subscriptions/0/problem").asText()));
            }
            Sleep.of(POLL_INTERVAL);
        }
        throw new CommandException("The source did not subscribe at %s within %d s; see furrow.log"
                .formatted(contextBroker, TIMEOUT.toSeconds()));
    }

    /** Empty while nothing listens: after a restart the worker still reports the previous task as running. */
    private JsonNode check(URI health) {
        try {
            return rest.get(health, Map.of()).body();
        } catch (UncheckedIOException e) {
            if (e.getCause() instanceof ConnectException) {
                return NgsiJson.mapper().missingNode();
            }
            throw e;
        }
    }

    /** Creates or updates the sink that writes results to the context broker; refused ones go to {@link #DEAD_RESULTS}. */
    void sink(URI contextBroker, List<String> topics) {
        Map<String, String> settings = toBroker(contextBroker);
        settings.put("connector.class", "io.furrow.connect.sink.NgsiSinkConnector");
        settings.put("tasks.max", "1");
        settings.put("topics", String.join(",", topics));
        settings.put("delete.on.null", "true");
        settings.put("errors.tolerance", "all");
        settings.put("errors.deadletterqueue.topic.name", DEAD_RESULTS);
        settings.put("errors.deadletterqueue.context.headers.enable", "true");
        put("ngsi-sink", settings);
    }

    /** Creates or updates a connector and returns when its first task runs. */
    public void put(String name, Map<String, String> settings) {
        ObjectNode body = NgsiJson.mapper().createObjectNode();
        settings.forEach(body::put);
        body.put("key.converter", "org.apache.kafka.connect.storage.StringConverter");
        body.put("value.converter", "org.apache.kafka.connect.converters.ByteArrayConverter");
        body.put("header.converter", "org.apache.kafka.connect.storage.StringConverter");
        RestClient.Answer answer = rest.send("PUT", connect.resolve("/connectors/" + name + "/config"), Map.of(), body);
        if (!answer.isSuccess()) {
            throw new CommandException("Connect refused the connector %s: %s"
                    .formatted(name, answer.body().path("message").asText()));
        }
        awaitRunning(name);
    }

    private void awaitRunning(String name) {
        Instant end = Instant.now().plus(TIMEOUT);
        JsonNode status = NgsiJson.mapper().missingNode();
        while (Instant.now().isBefore(end)) {
            status = rest.get(connect.resolve("/connectors/" + name + "/status"), Map.of())
                    .body();
            String state = status.path("tasks").path(0).path("state").asText();
            if (state.equals("RUNNING")) {
                return;
            }
            if (state.equals("FAILED")) {
                String trace = status.path("tasks").path(0).path("trace").asText();
                throw new CommandException("The connector %s failed: %s"
                        .formatted(name, trace.lines().findFirst().orElse("")));
            }
            Sleep.of(POLL_INTERVAL);
        }
        throw new CommandException("The connector %s did not run within %d s; its status is %s"
                .formatted(name, TIMEOUT.toSeconds(), status));
    }
}
