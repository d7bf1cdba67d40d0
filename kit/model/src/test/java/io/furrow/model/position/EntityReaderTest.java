package io.furrow.model.position;

import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Optional;
import java.util.Random;
import java.util.Set;
import java.util.TreeSet;

import com.fasterxml.jackson.databind.JsonNode;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.MethodSource;

import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.JsonTestSuiteTest;
import io.furrow.model.ngsi.MadeUpEntities;
import io.furrow.model.ngsi.Mutations;
import io.furrow.model.ngsi.Notification;
import io.furrow.model.ngsi.Quantity;
import io.furrow.model.ngsi.Reason;
import io.furrow.model.ngsi.RecordedNotification;
import io.furrow.model.ngsi.UnreadableException;

import static java.nio.charset.StandardCharsets.ISO_8859_1;
import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatIllegalArgumentException;
import static org.assertj.core.api.Assertions.fail;

/**
 * Checks that the token reader returns the same as the tree reader: {@link Entity#parse}, {@link PositionReading#of}.
 */
class EntityReaderTest {
    private static final long SEED = 20261121;
    private static final Set<String> DESIRED = Set.of("temperature", "Mission", "TimeInstant", "Time", "speed", "id");

    private final EntityReader reader = new EntityReader(DESIRED);
    private int byTokens;

    /** Returns all that a job may read from an entity, or why it is unreadable. */
    private record Answer(
            String id, String type, PositionReading position, List<Object> attributes, Reason reason, String message) {}

    @Test
    void answersTheSameForRecordedEntities() throws Exception {
        List<Entity> entities = recordedEntities();
        entities.forEach(entity -> compare(entity.toBytes()));
        assertThat(byTokens).as("all entities were read without a tree").isEqualTo(entities.size());
        assertThat(entities).hasSizeGreaterThan(15);
        RecordedNotification.all().forEach(recorded -> compare(recorded.body()));
    }

    @Test
    void answersTheSameForRecordedEntitiesBrokenAtRandom() throws Exception {
        Random random = new Random(SEED);
        Mutations mutations = new Mutations(random);
        List<Entity> recorded = recordedEntities();
        for (int round = 0; round < 4000; round++) {
            compare(mutations.of(recorded.get(random.nextInt(recorded.size())).toBytes()));
        }
        assertThat(byTokens).as("entities read without a tree").isGreaterThan(1000);
    }

    @Test
    void answersTheSameForMadeUpEntities() {
        MadeUpEntities entities = new MadeUpEntities(new Random(SEED));
        for (int round = 0; round < 20_000; round++) {
            compare(bytes(entities.next()));
        }
        assertThat(byTokens).as("entities read without a tree").isGreaterThan(8_000);
    }

    @ParameterizedTest
    @MethodSource("io.furrow.model.ngsi.JsonTestSuiteTest#cases")
    void answersTheSameForTheTestSuiteOfJson(JsonTestSuiteTest.Case each) {
        compare(each.document());
        String document = new String(each.document(), ISO_8859_1);
        for (String attribute : List.of("temperature", "location", "Latitude", "nobodyWantsThis", "gnss")) {
            compare(within("{\"id\":\"a\",\"" + attribute + "\":{\"value\":", document, "}}"));
            compare(within("{\"id\":\"a\",\"" + attribute + "\":", document, "}"));
            compare(within("{\"id\":\"a\",\"" + attribute + "\":{\"value\":1,\"metadata\":", document, "}}"));
        }
        compare(within("{\"id\":", document, "}"));
        compare(within("{\"id\":\"a\",\"type\":", document, "}"));
    }

    @Test
    void answersTheSameForEveryPositionOfTheCaseTable() throws Exception {
        Path table = Path.of("src/test/resources/io/furrow/model/position/positions.csv");
        for (String line : Files.readAllLines(table)) {
            String keyValues = line.split(" \\| ")[0];
            if (!line.startsWith("#")) {
                byte[] body = bytes("{\"id\":\"a\"," + keyValues + "}");
                compare(Notification.read(body, "simplifiedKeyValues")
                        .entities()
                        .get(0)
                        .toBytes());
            }
        }
        assertThat(byTokens).isGreaterThan(40);
    }

    @Test
    void clearsThePreviousEntity() throws Exception {
        reader.read(bytes("{\"id\":\"a\",\"type\":\"Robot\",\"Latitude\":{\"value\":40},\"speed\":{\"value\":\"3\"}}"));
        assertThat(reader.number("speed")).isEqualTo(3);

        reader.read(bytes("{\"id\":\"b\"}"));

        assertThat(reader.id()).isEqualTo("b");
        assertThat(reader.type()).isEqualTo("Thing");
        assertThat(reader.has("speed")).isFalse();
        assertThat(reader.position()).isInstanceOf(PositionReading.Absent.class);
    }

    @Test
    void rejectsAttributesThatWereNotRequested() throws Exception {
        reader.read(bytes("{\"id\":\"a\"}"));
        assertThatIllegalArgumentException()
                .isThrownBy(() -> reader.has("Image"))
                .withMessageContaining("'Image' is not one of the requested attributes");
    }

    @Test
    void detectsDuplicateNamesAmongManyMembers() {
        for (int members : new int[] {2, 31, 32, 33, 34, 200}) {
            StringBuilder entity = new StringBuilder("{\"id\":\"a\"");
            for (int i = 0; i < members; i++) {
                entity.append(",\"x")
                        .append(i)
                        .append("\":{\"value\":")
                        .append(i)
                        .append("}");
            }
            compare(bytes(entity + "}"));
            assertThat(byTokens).isPositive();
            byTokens = 0;
            for (int twice : new int[] {0, members / 2, members - 1}) {
                compare(bytes(entity + ",\"x" + twice + "\":{\"value\":1}}"));
            }
            assertThat(byTokens).isZero();
        }
    }

    /** Returns entities of all representations that name their attributes. */
    private static List<Entity> recordedEntities() throws UnreadableException {
        List<Entity> entities = new ArrayList<>();
        for (RecordedNotification recorded : RecordedNotification.all()) {
            if (!recorded.attrsFormat().equals("values")) {
                entities.addAll(Notification.read(recorded.body(), recorded.attrsFormat())
                        .entities());
            }
        }
        return entities;
    }

    private void compare(byte[] entity) {
        Answer ofTree = ofTree(entity);
        Answer ofReader = ofReader(entity);
        boolean tokens = reader.readTokens(entity);
        if (!ofReader.equals(ofTree) || tokens && ofTree.reason != null) {
            fail("of the tree %s, of the reader %s: %s", ofTree, ofReader, text(entity));
        }
        byTokens += tokens ? 1 : 0;
    }

    private Answer ofReader(byte[] entity) {
        try {
            reader.read(entity);
            List<Object> attributes = new TreeSet<>(DESIRED)
                    .stream().map(this::ofReader).map(Object.class::cast).toList();
            return new Answer(reader.id(), reader.type(), reader.position(), attributes, null, null);
        } catch (UnreadableException e) {
            return new Answer(null, null, null, null, e.reason(), e.getMessage());
        }
    }

    private List<Object> ofReader(String name) {
        double number = reader.number(name);
        return List.of(
                name,
                reader.has(name),
                reader.text(name),
                Double.isNaN(number) ? Optional.empty() : Optional.of(number),
                reader.number(name, Quantity.SPEED),
                reader.truth(name));
    }

    private static Answer ofTree(byte[] bytes) {
        try {
            Set<String> desired = new TreeSet<>(DESIRED);
            desired.addAll(PositionReading.ATTRIBUTES);
            Entity entity = Entity.parse(bytes, desired);
            List<Object> attributes = new TreeSet<>(DESIRED)
                    .stream()
                            .map(name -> ofTree(entity, name))
                            .map(Object.class::cast)
                            .toList();
            return new Answer(entity.id(), entity.type(), PositionReading.of(entity), attributes, null, null);
        } catch (UnreadableException e) {
            return new Answer(null, null, null, null, e.reason(), e.getMessage());
        }
    }

    private static List<Object> ofTree(Entity entity, String name) {
        return List.of(
                name,
                entity.value(name).isPresent(),
                entity.text(name),
                entity.number(name),
                Quantity.SPEED.of(entity, name).orElse(Double.NaN),
                entity.value(name).filter(JsonNode::isBoolean).map(JsonNode::booleanValue));
    }

    private static byte[] within(String before, String document, String after) {
        return (before + document + after).getBytes(ISO_8859_1);
    }

    private static byte[] bytes(String text) {
        return text.getBytes(UTF_8);
    }

    private static String text(byte[] entity) {
        String text = new String(entity, UTF_8);
        return text.substring(0, Math.min(text.length(), 2000));
    }
}
