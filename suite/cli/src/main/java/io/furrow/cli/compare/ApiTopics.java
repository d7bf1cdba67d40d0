package io.furrow.cli.compare;

import java.util.ArrayList;
import java.util.Collection;
import java.util.Collections;
import java.util.HashMap;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.function.Consumer;

import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.cli.control.client.ControlApi;
import io.furrow.model.ngsi.NgsiJson;

/** Reads topics over the REST API, which has the newest records first. */
record ApiTopics(ControlApi api) implements ResultTopics {
    private static final String TOPICS = "/api/v1/topics";
    /** The most that a page has; one of large values has fewer. */
    private static final int PAGE = 1_000;
    /** Several, because the newest records may be of an earlier epoch. */
    private static final int NEWEST = 100;

    @Override
    public Collection<String> names() {
        return api.get(TOPICS).findValuesAsText("topic");
    }

    @Override
    public void read(String topic, long from, Consumer<ResultRecord> reader) {
        List<ResultRecord> newestFirst = new ArrayList<>();
        api.pages(
                path(topic, PAGE, from > 0 ? from : null), page -> page.forEach(each -> newestFirst.add(record(each))));
        Collections.reverse(newestFirst);
        newestFirst.forEach(reader);
    }

    @Override
    public void readNewest(String topic, Consumer<ResultRecord> reader) {
        api.list(path(topic, NEWEST, null), NEWEST).elements().forEach(each -> reader.accept(record(each)));
    }

    private static String path(String topic, int limit, Long from) {
        Map<String, Object> query = new LinkedHashMap<>();
        query.put("values", true);
        query.put("limit", limit);
        query.put("from", from);
        return TOPICS + ControlApi.part(topic) + "/records" + ControlApi.query(query);
    }

    private static ResultRecord record(JsonNode record) {
        Map<String, String> headers = new HashMap<>();
        record.path("headers")
                .properties()
                .forEach(
                        header -> headers.put(header.getKey(), header.getValue().asText()));
        String place = "%s-%s@%s"
                .formatted(
                        record.path("topic").asText(),
                        record.path("partition").asText(),
                        record.path("offset").asText());
        return new ResultRecord(place, headers, record.has("value") ? NgsiJson.write(record.get("value")) : null);
    }

    @Override
    public void close() {
        // has no connection of its own
    }
}
