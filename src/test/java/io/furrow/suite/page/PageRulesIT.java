package io.furrow.suite.page;

import java.io.IOException;
import java.io.InputStream;
import java.net.URI;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;

import com.microsoft.playwright.Browser;
import com.microsoft.playwright.Page;
import com.microsoft.playwright.Route;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Test;

import io.furrow.dashboard.Dashboard;

import static org.assertj.core.api.Assertions.assertThat;

/** Runs modules of the page in a browser without a suite, on the tables of cases that also apply to the jobs. */
class PageRulesIT {
    private static final Path TABLES = Path.of("../kit/model/src/test/resources/io/furrow/model");
    private static final String FARM = "http://page.test/";

    /** Applies reports of one entity in one tenant. */
    private static final String REPORT = """
            const { store } = await import('/core/store.js');
            const { parse } = await import('/core/json.js');
            let time = 1e12;
            const report = (id, type, tenant, attributes) => store.applyEntity({
              key: id, kind: 'event', time: time += 1000, headers: { 'fiware-service': tenant, 'fiware-servicepath': '/' },
              value: attributes && { id, type, ...attributes } });
            """;

    @AutoClose
    private static Chromium chromium;

    private static Page page;

    @BeforeAll
    static void open() {
        chromium = Chromium.start();
        page = chromium.browser()
                .newContext(new Browser.NewContextOptions()
                        .setTimezoneId("Europe/Madrid")
                        .setLocale("en-GB"))
                .newPage();
        page.route("**/*", PageRulesIT::answer);
        page.navigate(FARM);
    }

    @Test
    void readsPositionsAsTheJobsDo() throws IOException {
        assertThat(differences("position/positions.csv", """
                const { positionOf } = await import('/core/readings.js');
                const { parse } = await import('/core/json.js');
                return rows.filter(([attributes, latitude, longitude]) => {
                  const found = positionOf(Object.fromEntries(Object.entries(parse(`{${attributes}}`)).map(([name, value]) => [name, { value }])));
                  return String(found.position ?? (found.fault ? 'fault' : 'absent')) !== String(isNaN(latitude) ? latitude : [+longitude, +latitude]);
                });""")).isEmpty();
    }

    @Test
    void readsNumbersAndUnitsAsTheJobsDo() throws IOException {
        assertThat(differences("ngsi/quantities.csv", """
                const { quantityOf } = await import('/core/readings.js');
                const { parse } = await import('/core/json.js');
                return rows.filter(([quantity, attribute, expected]) => {
                  const read = quantityOf(parse(attribute), quantity);
                  return expected === 'none' ? read !== null : !(Math.abs(read - expected) < 1e-9);
                });""")).isEmpty();
    }

    @Test
    void recognizesCommandsAsTheControlPlaneDoes() throws IOException {
        assertThat(differences("ngsi/commands.csv", """
                const { isOfCommand } = await import('/core/readings.js');
                return rows.filter(([name, attribute, expected]) => String(isOfCommand(name, JSON.parse(attribute))) !== expected);""")).isEmpty();
    }

    /** A tractor reports the state of its engine, and an object as the result of each command. */
    @Test
    void takesNeitherAMeasureForACommandNorAnOldResultForANewOne() {
        assertThat(run(REPORT + """
                const { keyAttributes } = await import('/cards/attributes.js');
                const { commandsOf, outcomeOf } = await import('/cards/commands.js');
                const reply = (status, code) => report('tractor', 'Tractor', '', { engine_status: { type: 'Text', value: 'running' },
                  plow_status: { type: 'commandStatus', value: status }, plow_info: { type: 'commandResult', value: { code } } });
                reply('OK', 0);
                const entity = store.entities.get('tractor');
                const sent = { command: 'plow', at: 0, info: '{"code":0}', waiting: false };
                reply('PENDING', 0);
                const pending = outcomeOf(entity, sent, 0).state;
                reply('PENDING', 1);
                const { state, info } = outcomeOf(entity, sent, 0);
                store.applyEntity({ key: 'tractor', kind: 'event', time: time - 9000, headers: { 'fiware-service': '', 'fiware-servicepath': '/' }, value: { id: 'tractor', type: 'Tractor', engine_status: { type: 'Text', value: 'off' } } });
                return [pending, `${state} ${info}`, ...commandsOf(entity).map(({ name }) => name), ...keyAttributes(entity).map(({ name, value }) => `${name}=${value}`)];""")).containsExactly("pending", "ok {\"code\":1}", "plow", "engine_status=running");
    }

    /** As the control plane does, which reports no silence of such a device. */
    @Test
    void recognizesThatADeviceIsSwitchedOff() {
        assertThat(run(REPORT + """
                return [false, 0, '0', 'Off', true, 1, 'on', null].map((value, index) => {
                  report(`switch ${index}`, 'Switch', '', { Status: { value }, Mission: { value: index } });
                  const { state, mission } = store.entities.get(`switch ${index}`);
                  return `${mission} ${state}`;
                });"""))
                .containsExactly("0 off", "1 off", "2 off", "3 off", "4 stale", "5 stale", "6 stale", "7 stale");
    }

    @Test
    void drawsALineInTheUnitThatIsShown() {
        assertThat(run(REPORT + """
                const { lineOf } = await import('/cards/attributes.js');
                const { displayOf } = await import('/core/format.js');
                const { Sparkline } = await import('/cards/sparkline.js');
                const words = (id) => {
                  const entity = store.entities.get(id);
                  const line = lineOf(entity);
                  const spark = new Sparkline();
                  spark.draw(line, line && { label: 'x', ...displayOf(line.name, entity.attributes[line.name]) });
                  return line && [...spark.shown.values].map((value) => Math.round(value * 10) / 10).join() + spark.shown.unit;
                };
                [0.5, 0.55, 0.6].forEach((value) => report('leaf', 'Leaf', '', { relativeHumidity: { value } }));
                [[20, 'CEL'], [21, 'CEL'], [70, 'FAH'], [71, '°F'], [72, 'FAH']].forEach(([value, unit]) => report('soil', 'Soil', '', { temperature: { value, metadata: { unitCode: { value: unit } } } }));
                return [words('leaf'), words('soil')];""")).containsExactly("50,55,60%", "70,71,72FAH");
    }

    @Test
    void readsBatteriesAsTheControlPlaneDoes() throws IOException {
        assertThat(differences("ngsi/batteries.csv", REPORT + """
                const { chargeOf } = await import('/core/readings.js');
                return rows.filter(([reports, expected, known], index) => {
                  const id = `battery ${index}`;
                  known && store.devices.set(id, { id, type: 'Battery', service: '', servicePath: '/', health: { percent: true } });
                  parse(reports).forEach((each) => report(id, 'Battery', '', each));
                  const read = chargeOf(store.entities.get(id).attributes);
                  return expected === 'none' ? read !== null : !(Math.abs(read - expected) < 1e-9);
                });""")).isEmpty();
    }

    @Test
    void readsABatteryInPercentIfAReportBeforeThePageWasOpenedShowsIt() {
        assertThat(run(REPORT + """
                const { chargeOf } = await import('/core/readings.js');
                report('past', 'Battery', '', parse('{"battery": {"value": 1}}'));
                store.applyPast([{ key: 'past', kind: 'event', time: time - 1, headers: { 'fiware-service': '', 'fiware-servicepath': '/' }, value: { id: 'past', type: 'Battery', ...parse('{"battery": {"value": 3}}') } }]);
                return [`${chargeOf(store.entities.get('past').attributes)}`];""")).containsExactly("0.01");
    }

    @Test
    void showsNumbersUnchangedAndWithTheirUnits() {
        assertThat(run(REPORT + """
                const { allAttributes, keyAttributes } = await import('/cards/attributes.js');
                const { quantityOf } = await import('/core/readings.js');
                report('a', 'Device', '', parse(`{"code": {"value": 840380235174088834}, "least": {"value": -9007199254740993}, "far": {"value": 1E400},
                  "zeros": {"value": "0042"}, "battery": {"value": 1, "metadata": {"unitCode": {"value": "P1"}}}, "batteryLevel": {"value": 0.07},
                  "speed": {"value": "36", "metadata": {"unitCode": {"value": "KMH"}}}, "serial": {"value": 12345678901},
                  "energy": {"value": 12345678901234567, "metadata": {"unitCode": {"value": "WHR"}}}}`));
                const entity = store.entities.get('a');
                return [...allAttributes(entity).map(({ name, value }) => `${name}=${value}`),
                  ...keyAttributes(entity, 9).map(({ label, value, unit }) => `${label}: ${value} ${unit}`.trim()), `${entity.speed} m/s`];"""))
                .contains(
                        "code=840380235174088834",
                        "least=-9007199254740993",
                        "far=1E400",
                        "zeros=0042",
                        "energy=12345678901234567",
                        "Code: 840380235174088834",
                        "Serial: 12 345 678 901",
                        "Battery: 1 %",
                        "Battery level: 7 %",
                        "Speed: 36 km/h",
                        "10 m/s");
    }

    /** Names of devices are whatever somebody gave them. */
    @Test
    void writesTablesAsCsvThatASpreadsheetDoesNotRun() {
        assertThat(run("""
                const { toCsv } = await import('/core/csv.js');
                const cell = (value) => toCsv([[value]]).slice(0, -2);
                return [toCsv([['a', 'b'], [1.5, -2]]), ...['=1+1', '+1', '-1', '@x', ' =1', 'a;=1', 'a\\n=1', '\\t=1', '＝1', 'a=1', 'a-b', 'say "x", y', "it's", '', null, undefined, NaN, new Date(0)].map(cell)];"""))
                .containsExactly(
                        "a,b\r\n1.5,-2\r\n",
                        "'=1+1",
                        "'+1",
                        "'-1",
                        "'@x",
                        " '=1",
                        "\"a;'=1\"",
                        "\"a\n'=1\"",
                        "\"\t'=1\"",
                        "'＝1",
                        "a=1",
                        "a-b",
                        "\"say \"\"x\"\", y\"",
                        "it's",
                        "",
                        "",
                        "",
                        "",
                        "1970-01-01T00:00:00.000Z");
    }

    /** The first report is from a device whose clock is two minutes behind, the second has a position of another time. */
    @Test
    void judgesADeviceByTheReceiptOfItsReports() {
        assertThat(run(REPORT + """
                const receive = (id, headers, value) => store.applyEntity({ key: id, kind: 'event', time: Date.now() - 120_000, headers, value: { id, type: 'Device', ...value } });
                receive('slow', { 'ts-source': String(Date.now()) }, { Temperature: { value: 20 } });
                receive('old', {}, { Temperature: { value: 20 } });
                receive('later', { 'later-attributes': 'Latitude,Longitude' }, { Latitude: { value: 20 }, Longitude: { value: 10 } });
                return [store.entities.get('slow').state, store.entities.get('old').state, String(store.entities.get('later').position)];""")).containsExactly("ok", "stale", "null");
    }

    /** The hour at the end of summer time occurs twice. */
    @Test
    void readsALocalTimeWithinTheRecording() {
        assertThat(run("""
                const { ofLocal } = await import('/core/local-time.js');
                const at = (last, bound) => new Date(ofLocal('2026-10-25T02:20:00', last, Date.parse(bound))).toISOString();
                return [at(false, '2026-10-25T01:05Z'), at(true, '2026-10-25T00:50Z'), at(false, ''), at(true, '')];"""))
                .containsExactly(
                        "2026-10-25T01:20:00.000Z",
                        "2026-10-25T00:20:00.000Z",
                        "2026-10-25T00:20:00.000Z",
                        "2026-10-25T01:20:00.000Z");
    }

    @Test
    void showsANewDeviceInsteadOfTheOneThatWasSilentLongestIfThereAreTooMany() {
        assertThat(run(REPORT + """
                store.clearShown();
                for (let i = 0; i <= 5_000; i++) {
                  report(`of many ${i}`, 'Device', '', {});
                }
                const shown = [0, 1, 5_000].map((i) => String(store.entities.has(`of many ${i}`)));
                store.clearShown();
                return shown;""")).containsExactly("false", "true", "true");
    }

    /** Attributes may have names that every JavaScript object has. */
    @Test
    void treatsNamesOfJavaScriptAsAttributeNames() {
        assertThat(run(REPORT + """
                const { allAttributes, keyAttributes } = await import('/cards/attributes.js');
                const { t } = await import('/texts.js');
                report('b', 'Device', '', parse(`{"constructor": {"value": 5}, "__proto__": {"value": 7},
                  "toString": {"value": 8, "metadata": {"unitCode": {"value": "valueOf"}}}}`));
                const entity = store.entities.get('b');
                return [...allAttributes(entity).map(({ name, value }) => `${name}=${value}`),
                  ...keyAttributes(entity, 9).map(({ value, unit }) => `${value} ${unit}`.trim()), t('states.constructor')];"""))
                .containsExactlyInAnyOrder(
                        "__proto__=7", "constructor=5", "toString=8", "5", "7", "8 valueOf", "states.constructor");
    }

    /** A device may name a domain and a mission, of which topics have an encoding. */
    @Test
    void findsTheDevicesOfADomainThatIsEncodedInTopics() {
        assertThat(run(REPORT + """
                const { arrange } = await import('/views/topics/tree.js');
                const { scopeName } = await import('/core/scope.js');
                report('sown', 'Robot', '', { Domain: { value: 'Höfe.7' }, Mission: { value: 'Feld 3' } });
                const tree = arrange([{ name: 'data._x-H-C3-B6fe-2E7.realtime' }, { name: 'data._x-H-C3-B6fe-2E7.realtime._x-Feld-203' }, { name: 'data.north.realtime._x-day-5Fdead' }], [],
                  [{ domain: 'north', mission: 'day_dead' }]).domains;
                const { domain, missions: [{ mission }] } = tree.find((each) => each.domain.startsWith('_x-'));
                store.setScope({ domain, mission });
                const shown = [scopeName(), store.inScope(store.entities.get('sown')), store.hasInScope('Feld 4', domain)];
                store.setScope({});
                return [...shown.map(String), ...tree.find((each) => each.domain === 'north').missions.map((each) => each.mission)];""")).containsExactly("Höfe.7 › Feld 3", "true", "false", "_x-day-5Fdead");
    }

    /** Tenant and type are not part of the id. */
    @Test
    void distinguishesEntitiesWithTheSameId() {
        assertThat(run(REPORT + """
                const at = (longitude) => ({ Latitude: { value: 10 }, Longitude: { value: longitude } });
                for (let i = 0; i < 4; i++) {
                  report('pb-14', 'Robot', 'pbfarm', at(10.002));
                  report('pb-14', 'Robot', 'pbother', at(10.004));
                }
                report('pb-13', 'Valve', 'pbfarm', at(10));
                report('pb-13', 'Pump', 'pbfarm', at(11));
                const summary = () => [...store.entities.values()].filter(({ identity }) => ['pb-13', 'pb-14'].includes(identity.id))
                  .map(({ name, position, trail }) => `${name} at ${position[0]}, ${trail.length} places`);
                const both = summary();
                store.applyEncounter({ time, headers: { 'fiware-service': 'pbother' }, value: { type: 'Analytics:Collision',
                  Device1_ID: { value: 'pb-14' }, Device2_ID: { value: 'x' }, phase: { value: 'started' } } });
                const [encounter] = store.encounters.values();
                const close = store.entities.get(encounter.a).name;
                report('pb-14', 'Robot', 'pbother', null);
                return [...both, `close: ${close}`, ...summary().slice(0, 1)];"""))
                .containsExactly(
                        "pb-14 (pbfarm) at 10.002, 0 places", "pb-14 (pbother) at 10.004, 0 places",
                        "pb-13 (Valve) at 10, 0 places", "pb-13 (Pump) at 11, 0 places",
                        "close: pb-14 (pbother)", "pb-14 at 10.002, 0 places");
    }

    @Test
    void showsAnEncounterOfDevicesOfTwoTenants() {
        assertThat(run(REPORT + """
                const { readEncounter } = await import('/timeline/moments.js');
                report('pb-19', 'Robot', 'pbfarm', {});
                report('pb-19', 'Robot', 'pbother', {});
                const record = { time, headers: { 'fiware-service': 'pbfarm' }, value: { type: 'Analytics:Collision', phase: { value: 'started' },
                  Device1_ID: { value: 'pb-19' }, Device2_ID: { value: 'pb-19' }, Device2_type: { value: 'Robot' },
                  Device2_service: { value: 'pbother' }, Device2_servicePath: { value: '/' } } };
                store.applyEncounter(record);
                const live = [...store.encounters.values()].find(({ a }) => a === 'pb-19');
                const past = readEncounter(record);
                return [...[live.a, live.b, past.a, past.b].map((key) => store.entities.get(key).name), past.pair];"""))
                .containsExactly(
                        "pb-19 (pbfarm)",
                        "pb-19 (pbother)",
                        "pb-19 (pbfarm)",
                        "pb-19 (pbother)",
                        "pb-19 (pbfarm) – pb-19 (pbother)");
    }

    /** Images and results may arrive before their entity, while another entity with the same id is shown. */
    @Test
    void assignsImagesAndResultsToTheirEntity() {
        assertThat(run(REPORT + """
                const { fullKey } = await import('/core/identities.js');
                const headers = (tenant) => ({ 'fiware-service': tenant });
                const picture = (tenant, type, sha256) => store.applyImage({ time, headers: headers(tenant), value: { entity: 'pb-15', type, sha256 } });
                const shown = () => [...store.entities.values()].filter(({ identity }) => identity.id === 'pb-15')
                  .map((entity) => `${entity.name}: ${store.imageOf(entity)?.sha256 ?? 'none'}${entity.suspect ? ', suspect' : ''}`);
                report('pb-15', 'Camera', 'one', {});
                picture('other', 'Camera', 'b');
                picture('one', 'Station', 'c');
                store.applyTemperature({ time, headers: headers('one'), value: { type: 'Analytics:FieldTemperature', field: { value: 'f' },
                  suspects: { value: ['pb-15'] }, suspectTypes: { value: ['Station'] } } });
                const first = shown();
                picture('one', 'Camera', 'a');
                report('pb-15', 'Camera', 'other', {});
                report('pb-15', 'Station', 'one', {});
                const last = shown();
                picture('one', undefined, 'old');
                return [...first, ...last, fullKey({ service: '', servicePath: '/' }, 'T', 'x')];"""))
                .containsExactly(
                        "pb-15: none",
                        "pb-15 (Camera one): a",
                        "pb-15 (Camera other): b",
                        "pb-15 (Station one): c, suspect",
                        "|/|T|x");
    }

    /** Devices of two tenants may be in one field. */
    @Test
    void showsTheAverageOfEachTenantInAField() {
        assertThat(run(REPORT + """
                const { Findings } = await import('/views/analyses/data.js');
                const { mapTables } = await import('/map/table.js');
                const tables = mapTables(() => {});
                const findings = Object.assign(Object.create(Findings.prototype), { replay: true, averagesByWindow: new Map() });
                report('pb-20', 'Thermometer', 'pbfarm', {});
                report('pb-20', 'Thermometer', 'pbother', {});
                store.applyField({ key: 'pb-f@2020-01-01T00:00:00Z', value: { properties: { name: 'North' }, geometry: { type: 'Polygon', coordinates: [] } } });
                const average = (tenant, value, suspects) => {
                  const record = { time, headers: { 'fiware-service': tenant }, value: { type: 'Analytics:FieldTemperature', field: { value: 'pb-f' },
                    averageTemperature: { value }, devices: { value: 3 }, suspects: { value: suspects }, windowStart: { value: 1 }, windowEnd: { value: 2 } } };
                  store.applyTemperature(record);
                  findings.applyAverage(record);
                };
                average('pbfarm', 18, ['pb-20']);
                const alone = findings.averages(0, 9).map(({ name }) => name);
                average('pbother', 22, []);
                tables.toggle();
                const rows = [...tables.element.querySelectorAll('tr')].filter(({ textContent }) => textContent.startsWith('North')).map(({ children }) =>
                  [...children].slice(0, 4).map(({ textContent }) => textContent).join(', '));
                tables.close();
                return [...alone, ...findings.averages(0, 9).map(({ name, value }) => `${name}: ${value}`), ...rows];"""))
                .containsExactly(
                        "North",
                        "North (pbfarm): 18",
                        "North (pbother): 22",
                        "North (pbfarm), 18.0 °C, 3, pb-20 (pbfarm)",
                        "North (pbother), 22.0 °C, 3, –");
    }

    /** The missions of a group are replayed at the same time, and the average of each is that of its own devices. */
    @Test
    void showsTheAverageOfEachMissionOfAGroupOfReplays() {
        assertThat(run(REPORT + """
                const { feeds } = await import('/core/feeds.js');
                const { Findings } = await import('/views/analyses/data.js');
                const opened = new Map();
                const feed = (topic, mode, apply) => opened.set(topic, apply) && { close: () => {} };
                const shown = Object.assign(Object.create(Object.getPrototypeOf(feeds)), { feed, follow: () => {}, readImages: () => {} });
                const members = ['hoeing', 'mowing'].map((mission) => ({ replay: `${mission}.1`, mission, topic: `data.${mission}.replay.1`, group: '2', analytics: ['temperature'] }));
                const { config, mode } = store;
                store.config = { ...config, analytics: ['temperature'] };
                members.forEach((each) => store.replays.set(each.replay, each));
                shown.enterReplay(members[0]);
                const record = (value, suspects) => ({ time, headers: { 'fiware-service': 'pbfarm' },
                  value: { type: 'Analytics:FieldTemperature', field: { value: 'pb-g' }, averageTemperature: { value }, suspects: { value: suspects } } });
                const average = (member, ...values) => opened.get(`${member.topic}.temperature`)(record(...values));
                report('pb-23', 'Thermometer', 'pbfarm', {});
                average(members[0], 18, ['pb-23']);
                const alone = store.averagesOf('pb-g').map(({ difference }) => `alone: ${difference}`);
                average(members[1], 22, []);
                const found = store.averagesOf('pb-g').map(({ value, difference }) => `${difference}: ${value}`);
                const suspect = store.entities.get('pb-23').suspect;
                const follow = (topic, range, apply) => apply(record(20, [])) ?? 5;
                const analyses = Object.assign(Object.create(Findings.prototype), { follow, notify: () => {}, replay: true, averagesByWindow: new Map() });
                await analyses.load({ averages: store.mode.results.temperature, encounters: [], stays: [] }, 5);
                members.forEach((each) => store.replays.delete(each.replay));
                store.config = config;
                store.setMode(mode);
                return [...alone, ...found, `suspect: ${suspect}`, ...analyses.averages(0, 2e12).map(({ name }) => name), `since ${analyses.since.averages}`];"""))
                .containsExactly(
                        "alone: ",
                        "hoeing: 18",
                        "mowing: 22",
                        "suspect: true",
                        "pb-g (hoeing)",
                        "pb-g (mowing)",
                        "since 5");
    }

    @Test
    void namesTheStaysOfDevicesWithTheSameId() {
        assertThat(run(REPORT + """
                const { Findings } = await import('/views/analyses/data.js');
                const findings = Object.assign(Object.create(Findings.prototype), { replay: true, staysById: new Map() });
                const stay = (device, tenant, type) => findings.applyStay({ time, headers: { 'fiware-service': tenant }, value: { type: 'Analytics:Presence',
                  stay: { value: `${tenant}-${type}` }, device: { value: device }, deviceType: { value: type }, field: { value: 'f' }, startTime: { value: 1 } } });
                stay('pb-24', 'pbfarm', 'Robot');
                stay('pb-24', 'pbother', 'Robot');
                stay('pb-24', 'pbother', 'Camera');
                stay('pb-25', 'pbother', 'Camera');
                return findings.stays(0, 9).map(({ name }) => name);"""))
                .containsExactly("pb-24 (Robot pbfarm)", "pb-24 (Robot pbother)", "pb-24 (Camera pbother)", "pb-25");
    }

    /** Before a mission starts: of entities with the id of a device, the one of its type, tenant and service path. */
    @Test
    void checksTheEntityOfAPlannedDevice() {
        assertThat(run(REPORT + """
                const { checkPlan, farmNow } = await import('/views/missions/check.js');
                const battery = (value) => ({ battery: { value } });
                report('pb-26', 'Robot', 'pbfarm', battery(10));
                report('pb-26', 'Camera', 'pbfarm', battery(90));
                report('pb-27', 'Robot', 'pbother', battery(10));
                report('pb-27', 'Robot', 'pbfarm', battery(90));
                store.devices.set('pb-28', { id: 'pb-28', type: 'Robot', service: 'pbfarm', servicePath: '/', wanted: 'stopped' });
                const checked = checkPlan([{ id: 'pb-26', type: 'Camera' }, { id: 'pb-26', type: 'Pump' }, { id: 'pb-27', type: 'Robot' }, 'pb-27'], 'd', farmNow('m'));
                store.devices.delete('pb-28');
                return checked.map(({ name, findings }) => `${name}: ${findings.map(({ values, text }) => values.percent ?? text).find((each) => !['seen', 'silent'].includes(each))}`);""")).containsExactly("pb-26: 90", "pb-26: made", "pb-27: 90", "pb-27: 90");
    }

    @Test
    void findsForADeviceTheEntityOfItsType() {
        assertThat(run(REPORT + """
                report('pb-17', 'Camera', 'pbfarm', {});
                report('pb-17', 'ROBOT', 'pbfarm', {});
                const of = (type) => store.entityOf({ id: 'pb-17', type, service: 'pbfarm', servicePath: '/' })?.type ?? 'none';
                return [of('Robot'), of('Camera'), of('Pump'), of(undefined)];
                """)).containsExactly("ROBOT", "Camera", "none", "Camera");
    }

    /** A picture that cannot be loaded now is shown later. */
    @Test
    void loadsAPictureAgainThatTheServerDoesNotKnowYet() {
        assertThat(run(REPORT + """
                const { Picture } = await import('/cards/picture.js');
                const [fetchPage, now] = [window.fetch, Date.now];
                const problem = (status) => new Response('{"error":"e","reason":"r"}', { status });
                const picture = new Picture();
                report('pb-18', 'Camera', 'pbfarm', {});
                const entity = store.entities.get('pb-18');
                store.applyImage({ time, headers: { 'fiware-service': 'pbfarm' }, value: { entity: 'pb-18', type: 'Camera', sha256: 'a' } });
                const shown = [];
                let clock = 0;
                Date.now = () => clock;
                for (const [at, answer] of [[0, problem(503)], [1999, new Response('x')], [2000, problem(404)], [9000, new Response('x')]]) {
                  clock = at;
                  window.fetch = async () => (shown.push(answer.status), answer);
                  await picture.draw(entity);
                }
                Object.assign(window, { fetch: fetchPage });
                Date.now = now;
                return shown.map(String);
                """)).containsExactly("503", "404");
    }

    /** The type need not be known. */
    @Test
    void showsForAnAlarmNoDeviceOfAnotherTenant() {
        assertThat(run(REPORT + """
                await import('/alarms/alarms.js');
                const alarms = document.body.appendChild(document.createElement('furrow-alarms'));
                report('pb-16', 'Robot', 'pbfarm', {});
                const shown = (service) => {
                  store.select(null);
                  store.applyAlarm({ key: service, value: { alarm: service, kind: 'suspect-sensor', severity: 'warning', state: 'open', text: 'odd',
                    raised: 1, subject: 'pb-16', identity: `${service}|/||pb-16`, devices: [{ id: 'pb-16', service }] } });
                  alarms.draw();
                  alarms.rows.get(service).element.querySelector('.alarm-text').click();
                  return String(store.selection);
                };
                const all = [shown('pbother'), shown('pbfarm')];
                alarms.remove();
                return all;""")).containsExactly("null", "pb-16");
    }

    @Test
    void showsAFieldFromItsValidityOn() {
        assertThat(run("""
                const { store } = await import('/core/store.js');
                const begin = Date.parse('2026-03-01T08:00:00Z');
                const at = (time) => {
                  store.now = () => time;
                  store.tick();
                  return String(store.fields.has('pb-field'));
                };
                store.now = () => begin - 1000;
                store.applyField({ key: 'pb-field@2026-03-01T08:00:00.000Z', value: { properties: {}, geometry: { type: 'Polygon', coordinates: [] } } });
                const shown = [String(store.fields.has('pb-field')), at(begin - 1), at(begin)];
                delete store.now;
                return shown;""")).containsExactly("false", "false", "true");
    }

    /** At the end of summer time the hour from two to three occurs twice. */
    @Test
    void writesTimesOnTheAxisAcrossTheEndOfSummerTime() {
        assertThat(run("""
                const { Scale } = await import('/timeline/scale.js');
                const { clock } = await import('/core/format.js');
                const ticks = (from, to, width) => {
                  const scale = new Scale();
                  scale.width = width;
                  scale.setExtent(Date.parse(from), Date.parse(to));
                  scale.showAll();
                  return scale.ticks().times.map((time) => clock(time).slice(0, 5)).join(' ');
                };
                return [ticks('2026-10-24T22:00Z', '2026-10-25T05:00Z', 700), ticks('2026-10-24T16:00Z', '2026-10-25T17:00Z', 500)];"""))
                .containsExactly("00:00 01:00 02:00 02:00 03:00 04:00 05:00 06:00", "18:00 00:00 06:00 12:00 18:00");
    }

    /** Rows of a table for which a function returns other results than the table. */
    private static List<?> differences(String table, String body) throws IOException {
        List<List<String>> rows = Files.readAllLines(TABLES.resolve(table)).stream()
                .filter(line -> !line.startsWith("#"))
                .map(line -> List.of(line.split(" \\|(?: |$)")))
                .toList();
        assertThat(rows).hasSizeGreaterThan(20);
        return (List<?>) page.evaluate("async (rows) => {" + body + "}", rows);
    }

    @SuppressWarnings("unchecked")
    private static List<String> run(String body) {
        return (List<String>) page.evaluate("async () => {" + body + "}");
    }

    private static void answer(Route route) {
        String path = URI.create(route.request().url()).getPath();
        Route.FulfillOptions answer = new Route.FulfillOptions();
        try (InputStream file = Dashboard.class.getResourceAsStream("/web" + path)) {
            boolean isScript = file != null && path.endsWith(".js");
            route.fulfill(
                    isScript
                            ? answer.setContentType("text/javascript").setBodyBytes(file.readAllBytes())
                            : answer.setContentType("text/html").setBody("<!doctype html>"));
        } catch (IOException e) {
            route.abort();
        }
    }
}
