package io.furrow.bench.sink;

import java.util.List;

import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.bench.frame.Figures;

/** The runs of one kind and their median. */
record SinkReport(String title, Plan plan, List<Run> runs) {
    /**
     * The input of the sink.
     *
     * @param records in the topic before the sink starts
     * @param entities of the records; as many as records if each has its own
     * @param payloadBytes of a notification with such an entity
     */
    record Plan(int records, int entities, int payloadBytes) {}

    /**
     * The sink's run over the records of a topic.
     *
     * @param nanos from the first request to the last, or from the sink's start to its last commit if {@code entities} is 0
     * @param entities in the requests; 0 if the receiver does not count
     * @param requests updates and queries
     * @param missing entities whose newest record did not arrive
     * @param bareEntitiesPerSecond entities, a hundred per body, accepted by a server that only answers
     */
    record Run(long nanos, long entities, long requests, long missing, double bareEntitiesPerSecond) {}

    /** Records per second: each is an update of an entity, whether or not it was merged with others. */
    private double updatesPerSecond(Run run) {
        return plan.records * 1e9 / run.nanos;
    }

    /** Updates per second; of an even number of runs the upper median. */
    double median() {
        return Figures.median(runs, this::updatesPerSecond);
    }

    /** Entities whose newest state did not arrive, of all runs. */
    long missing() {
        return runs.stream().mapToLong(Run::missing).sum();
    }

    Figures figures() {
        Figures figures = new Figures("%s: %d records of %d bytes about %d entities"
                .formatted(title, plan.records, plan.payloadBytes, plan.entities));
        for (Run run : runs) {
            figures.add(
                    "run", Integer.toString(runs.indexOf(run) + 1),
                    "updates/s", updatesPerSecond(run),
                    "entities", run.entities,
                    "requests", run.requests,
                    "missing", run.missing,
                    "bare server", run.bareEntitiesPerSecond);
        }
        return figures.add("run", "median", "updates/s", median());
    }

    /** Every figure of every run. */
    ObjectNode json() {
        ObjectNode json = JsonNodeFactory.instance.objectNode();
        json.put("title", title).put("medianUpdatesPerSecond", median());
        for (Run run : runs) {
            json.withArray("runs")
                    .addObject()
                    .put("records", plan.records)
                    .put("entitiesInTopic", plan.entities)
                    .put("updatesPerSecond", updatesPerSecond(run))
                    .put("entitiesWritten", run.entities)
                    .put("requests", run.requests)
                    .put("missing", run.missing)
                    .put("bareServerEntitiesPerSecond", run.bareEntitiesPerSecond);
        }
        return json;
    }
}
