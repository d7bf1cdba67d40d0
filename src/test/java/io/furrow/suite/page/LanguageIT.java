package io.furrow.suite.page;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.Set;
import java.util.TreeSet;
import java.util.regex.Pattern;
import java.util.stream.Stream;

import com.deque.html.axecore.playwright.AxeBuilder;
import com.microsoft.playwright.Locator;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;

import io.furrow.files.Folders;
import io.furrow.model.control.ErrorCode;

import static com.microsoft.playwright.assertions.PlaywrightAssertions.assertThat;
import static org.assertj.core.api.Assertions.assertThat;

/** The page in another language than English. */
@Tag("full")
class LanguageIT extends StubbedPage {
    @BeforeEach
    void start() {
        farm.hasRobot(1).hasAlarms(1).hasField("barn", "farm", 1, 2);
    }

    @Test
    void hasEachTextWellFormedWithTheSameValues() {
        FarmPage page = farm.open("", 1440, 900);

        assertThat((List<?>) page.run("""
                async () => {
                  const flat = (section, path = '') => Object.entries(section).flatMap(([name, text]) =>
                    typeof text === 'object' ? flat(text, `${path}${name}.`) : `${path}${name} ${[...text.matchAll(/\\{(\\w+)/g)].map((hole) => hole[1]).sort()}`);
                  const malformed = (section, path = '') => Object.entries(section).flatMap(([name, text]) => typeof text === 'object' ? malformed(text, `${path}${name}.`)
                    : /[{}|]/.test(text.replace(/\\{\\w+(:? [^{}|]+\\|[^{}|]+)?\\}/g, '')) ? [`${path}${name}`] : []);
                  const english = flat((await import('/texts.js')).texts);
                  const spanish = flat({ ...(await import('/texts.es.js')).texts, words: {}, sentences: {}, details: {}, groups: {}, refusals: {}, commands: {}, reported: {} });
                  const without = (ours, theirs) => ours.filter((each) => !theirs.includes(each));
                  return [...without(english, spanish), ...without(spanish, english), ...malformed((await import('/texts.js')).texts), ...malformed((await import('/texts.es.js')).texts)];
                }""")).isEmpty();
    }

    @Test
    void isThatOfTheBrowserUntilAnotherIsChosen() {
        FarmPage page = farm.isReadIn("es-MX").open("", 1440, 900);
        assertThat(page.find("html")).hasAttribute("lang", "es");
        assertThat(page.find(".rail")).containsText("Misiones");
        assertThat(page.card("urn:ngsi-ld:Robot:1")).containsText("1,50");
        assertThat(page.card("urn:ngsi-ld:Robot:1")).containsText("en marcha");

        page.button("Ajustes").click();
        page.button("English").click();
        assertThat(page.find("html")).hasAttribute("lang", "en");
        assertThat(page.find(".rail")).containsText("Missions");
        assertThat(page.card("urn:ngsi-ld:Robot:1")).containsText("1.50");
    }

    @Test
    void makesTheSentencesOfAlarms() {
        FarmPage page = farm.isReadIn("es")
                .has("service.alarms", "c", """
                        {"alarm": "c", "kind": "collision", "severity": "critical", "text": "…", "values": {"meters": 2.14}, "subject": "c", "raised": 1, "count": 1, "state": "open",
                         "devices": [{"id": "urn:ngsi-ld:Robot:1", "type": "ROBOT"}, {"id": "urn:ngsi-ld:Robot:2", "type": "ROBOT"}]}""")
                .has("service.alarms", "f", """
                        {"alarm": "f", "kind": "fault", "severity": "major", "text": "the task 0 failed", "subject": "f", "raised": 1, "count": 1, "state": "open"}""")
                .has("service.alarms", "k", """
                        {"alarm": "k", "kind": "fault", "severity": "major", "text": "…", "subject": "k", "raised": 1, "count": 1, "state": "open",
                         "details": [{"code": "connector-failed", "values": {"connector": "ngsi", "failure": "no disk", "command": "curl"}}]}""")
                .has("service.alarms", "s", """
                        {"alarm": "s", "kind": "silent-device", "severity": "minor", "text": "…", "subject": "s", "raised": 1, "count": 1, "state": "open",
                         "group": "urn:ngsi-ld:Mission:m", "affected": 2, "total": 3, "devices": [{"id": "urn:ngsi-ld:Robot:1"}, {"id": "urn:ngsi-ld:Robot:2"}],
                         "details": [{"device": "urn:ngsi-ld:Robot:2", "code": "wrong-password", "values": {"count": "1", "time": "0", "user": "u"}}]}""")
                .open("", 1440, 900);

        assertThat(page.find(".alarm.minor .alarm-text"))
                .hasText(
                        "2 de 3 dispositivos de la misión m sin señal: Robot 1, Robot 2 (su contraseña fue rechazada 1 vez; la última: 1 ene 1970, 01:00:00)");
        assertThat(page.find(".alarm.major .alarm-text").last())
                .hasText("El conector ngsi falló: no disk. Corríjalo y después: curl");
        assertThat(page.find(".alarm.critical .alarm-text")).hasText("Robot 1 y Robot 2 llegaron a 2,1\u00a0m");
        assertThat(page.find(".alarm.major .alarm-text").first()).hasText("the task 0 failed");
        assertThat(page.find(".alarm.major .alarm-text").first()).hasAttribute("lang", "en");
    }

    /** The map writes the same distances beside the pair. */
    @Test
    void saysTheDistancesOfACollision() {
        String encounter = """
                {"type": "Analytics:Collision", "encounter": {"value": "e"}, "phase": {"value": "%s"}, "distance": {"value": 4}, "minDistance": {"value": 3},
                 "Device1_ID": {"value": "urn:ngsi-ld:Robot:1"}, "Device2_ID": {"value": "urn:ngsi-ld:Robot:2"}}""";
        FarmPage page = farm.hasRobot(2)
                .has("data.collision", "e", encounter.formatted("ongoing"))
                .has("service.alarms", "c", """
                        {"alarm": "c", "kind": "collision", "severity": "critical", "text": "…", "values": {"meters": 4.7}, "subject": "c", "raised": 1, "count": 1, "state": "open",
                         "devices": [{"id": "urn:ngsi-ld:Robot:1", "type": "ROBOT"}, {"id": "urn:ngsi-ld:Robot:2", "type": "ROBOT"}]}""")
                .open("", 1440, 900);
        Locator text = page.find(".alarm.critical .alarm-text");
        assertThat(text).hasText("Robot 1 and Robot 2 are 11.1\u00a0m apart, closest 3.0\u00a0m");
        assertThat(text).hasAttribute("lang", "en");

        farm.send(
                "data.raw", "urn:ngsi-ld:Robot:2", StubFarm.robot(2, "Running", "farm", "weeding", 40.31262, -3.4822));
        assertThat(text).hasText("Robot 1 and Robot 2 are 2.2\u00a0m apart, closest 2.2\u00a0m");
        farm.send("data.collision", "e", encounter.formatted("ended"));
        assertThat(text).hasText("Robot 1 and Robot 2 came within 3.0\u00a0m");
    }

    @Test
    void saysWhyARequestIsRejected() {
        FarmPage page = farm.isReadIn("es")
                .answers("/api/alarms/a1/acknowledge", "409 wrong-state: alarm 'a1' is closed")
                .open("", 1440, 900)
                .expectingError("status of 409");
        page.find(".alarm").first().getByText("Reconocer").click();

        assertThat(page.find(".alarm").first()).containsText("su estado no lo permite: alarm 'a1' is closed");
    }

    @Test
    void hasARefusalForEachCode() {
        FarmPage page = farm.open("", 1440, 900);

        assertThat((List<?>) page.run("async () => Object.keys((await import('/texts.es.js')).texts.refusals)"))
                .extracting(Object::toString)
                .containsAll(Stream.of(ErrorCode.values()).map(ErrorCode::code).toList());
    }

    /** They are the literals of that form in the classes that say why a device is silent or what has failed. */
    @Test
    void hasADetailForEachCode() throws IOException {
        Set<String> codes = new TreeSet<>();
        for (String part : List.of("control-plane", "kit/model/src/main/java/io/furrow/model/device")) {
            for (Path file : Folders.walk(Path.of("..", part))) {
                String source = file.toString().matches(".*/src/main/.*\\.java") ? Files.readString(file) : "";
                if (Pattern.compile(
                                "new (SilenceCause|Fault|MissionStatus\\.Missing)\\(|(UNKNOWN_USER|WRONG_PASSWORD) =")
                        .matcher(source)
                        .find()) {
                    Pattern.compile("\"([a-z]+(-[a-z]+)+)\"")
                            .matcher(source)
                            .results()
                            .forEach(code -> codes.add(code.group(1)));
                }
            }
        }
        codes.remove("connector-watch"); // a thread
        assertThat(codes).contains("no-measure", "not-simulated", "unknown-user", "devices-retained");

        assertThat((List<?>) farm.open("", 1440, 900)
                        .run("async () => Object.keys((await import('/texts.es.js')).texts.details)"))
                .extracting(Object::toString)
                .containsExactlyInAnyOrderElementsOf(codes);
    }

    @Test
    void isAccessibleInEachView() {
        FarmPage page = farm.isReadIn("es")
                .answers(
                        "/api/platform",
                        "{\"kafka\": {}, \"controlPlane\": {\"parts\": {}}, \"groups\": [], \"deadLetters\": []}")
                .open("", 1440, 900);
        for (String view : List.of("missions", "replays", "analyses", "topics", "platform")) {
            page.open("#/" + view);
            assertThat(page.find("furrow-" + view + " h1")).isVisible();
            assertThat(new AxeBuilder(page.page()).analyze().getViolations())
                    .as(view)
                    .extracting(rule -> rule.getId())
                    .isEmpty();
        }
    }
}
