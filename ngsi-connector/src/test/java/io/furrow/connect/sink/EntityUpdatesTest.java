package io.furrow.connect.sink;

import java.nio.charset.StandardCharsets;
import java.util.List;

import org.junit.jupiter.api.Test;

import io.furrow.connect.sink.EntityUpdates.Update;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.UnreadableException;

import static org.assertj.core.api.Assertions.assertThat;

class EntityUpdatesTest {
    private final EntityUpdates updates = new EntityUpdates();

    @Test
    void takesTheNewestValueOfEachAttributeByEventTime() {
        add(Entity.builder("a", "T").integer("x", 1).integer("y", 1).build(), 20);
        add(Entity.builder("a", "T").integer("x", 2).integer("z", 2).build(), 10);
        add(Entity.builder("a", "T").integer("y", 3).build(), 30);

        Update update = updates.merged().get(0);
        assertThat(updates.merged()).hasSize(1);
        assertThat(value(update, "x")).isEqualTo(1);
        assertThat(value(update, "y")).isEqualTo(3);
        assertThat(value(update, "z")).isEqualTo(2);
    }

    @Test
    void takesTheLastOfEqualTimes() {
        add(Entity.builder("a", "T").integer("x", 1).build(), 10);
        add(Entity.builder("a", "T").integer("x", 2).build(), 10);

        assertThat(value(updates.merged().get(0), "x")).isEqualTo(2);
    }

    @Test
    void keepsScopesAndTypesApartAndRemembersWhereEachCameFrom() {
        Entity entity = Entity.builder("a", "T").integer("x", 1).build();
        updates.add(FiwareScope.DEFAULT, entity, 1, 0);
        updates.add(new FiwareScope("agri", "/"), entity, 1, 1);
        updates.add(new FiwareScope("agri", "/plot1"), entity, 1, 2);
        updates.add(FiwareScope.DEFAULT, Entity.builder("a", "U").build(), 1, 3);
        updates.add(FiwareScope.DEFAULT, entity, 1, 4);

        assertThat(updates.merged())
                .extracting(Update::sources)
                .containsExactly(List.of(0, 4), List.of(1), List.of(2), List.of(3));
    }

    @Test
    void leavesOutWhatOnlyTheContextBrokerSets() throws UnreadableException {
        Entity entity = Entity.parse("""
                {"id": "a", "type": "T", "dateModified": {"value": "2026-11-21T01:00:00Z"}, "servicePath": {"value": "/"},
                 "x": {"type": "Number", "value": 1, "metadata": {"unit": {"value": "m"}, "previousValue": {"value": 0},
                 "dateCreated": {"value": "2026-11-21T01:00:00Z"}}}}""".getBytes(StandardCharsets.UTF_8));

        add(entity, 1);

        assertThat(updates.merged().get(0).entity()).hasToString("""
                        {"id":"a","type":"T","x":{"type":"Number","value":1,"metadata":{"unit":{"value":"m"}}}}""");
        assertThat(entity.json().path("x").path("metadata").has("previousValue"))
                .as("the change itself is not touched")
                .isTrue();
    }

    private void add(Entity entity, long time) {
        updates.add(FiwareScope.DEFAULT, entity, time, 0);
    }

    private static int value(Update update, String attribute) {
        return update.entity().path(attribute).path("value").intValue();
    }
}
