package io.furrow.simulators.scenario;

import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.OptionalDouble;
import java.util.Set;

import io.furrow.model.control.MeasuredAttribute;
import io.furrow.model.device.DesiredDevice;
import io.furrow.simulators.device.DeviceRegistration;
import io.furrow.simulators.robot.RobotModel;
import io.furrow.simulators.robot.Trajectory;
import io.furrow.simulators.scenario.SimulatedDevice.Identity;
import io.furrow.simulators.scenario.SimulatedDevice.Place;
import io.furrow.simulators.scenario.SimulatedDevice.Quantity;
import io.furrow.simulators.signal.Curves;
import io.furrow.simulators.signal.RandomStream;
import io.furrow.simulators.signal.Signal;
import io.furrow.simulators.signal.TimeWindow;
import io.furrow.simulators.signal.Weather;

/**
 * Reads an entry of a mission's {@code devices}: a device, or a {@code count} of them that differ in place and seed.
 */
final class GroupReader {
    /** The types whose attributes are known, see {@link MeasuredAttribute}. */
    static final Set<String> TYPES = Set.of("Thermometer", "WeatherStation", "Camera", DesiredDevice.ROBOT);

    private static final long MAX_DEVICES = 100_000;
    private static final double COLDEST = -60;
    private static final double HOTTEST = 60;
    private static final double MAX = 1e9;
    private static final Duration WANDERS = Duration.ofMinutes(10);

    private final PlaceReader places;
    private final FaultReader faults;
    private final long seed;

    GroupReader(PlaceReader places, FaultReader faults, long seed) {
        this.places = places;
        this.faults = faults;
        this.seed = seed;
    }

    List<SimulatedDevice> devices(ScenarioObjectReader group, String domain, String mission)
            throws InvalidScenarioException {
        String type = group.text("type");
        String id = group.text("id");
        boolean many = group.has("count");
        long count = group.whole("count", 1, MAX_DEVICES, 1);
        String entity = group.text("entity", "urn:ngsi-ld:" + type + ":" + id);
        List<SimulatedDevice> devices = new ArrayList<>();
        for (long number = 1; number <= count; number++) {
            String end = many ? "-" + number : "";
            devices.add(device(group, new Identity(id + end, entity + end, type, domain, mission), number));
        }
        group.end();
        return devices;
    }

    /** Reads an entry without identity. */
    SimulatedDevice single(ScenarioObjectReader entry, Identity identity, long number) throws InvalidScenarioException {
        SimulatedDevice device = device(entry, identity, number);
        entry.end();
        return device;
    }

    private SimulatedDevice device(ScenarioObjectReader group, Identity identity, long number)
            throws InvalidScenarioException {
        Duration period = group.duration("period");
        if (period.isZero()) {
            throw group.refused("period", "must be longer than PT0S");
        }
        long own = RandomStream.seed(seed, identity.mission() + "/" + identity.id());
        return switch (identity.type()) {
            case "Thermometer", "WeatherStation" ->
                sensor(group, identity, number, own, quantities(identity.type(), weather(group, own)));
            case "Camera" -> camera(group, identity, number, own);
            case DesiredDevice.ROBOT -> robot(group, identity, period);
            default -> other(group, identity, number, own);
        };
    }

    /** Reads a custom type, which lists its attributes. */
    private SimulatedDevice other(ScenarioObjectReader group, Identity identity, long number, long own)
            throws InvalidScenarioException {
        if (!group.has("attributes")) {
            throw group.refused(
                    "type",
                    "'%s' is not a type of device; use Thermometer, WeatherStation, Camera or Robot"
                            .formatted(identity.type()));
        }
        List<Quantity> quantities = new ArrayList<>();
        for (ScenarioObjectReader attribute : group.objects("attributes")) {
            String name = attribute.text("name");
            double low = attribute.number("low", -MAX, MAX, 0);
            double high = attribute.number("high", low, MAX, low + 100);
            Signal middle = time -> OptionalDouble.of((low + high) / 2);
            Signal signal = middle.plus(Curves.wandering((high - low) / 2, WANDERS, RandomStream.seed(own, name)));
            String type = attribute.text("type", "Float");
            quantities.add(new Quantity(
                    new DeviceRegistration.Attribute(attribute.text("object_id", name), name, type),
                    signal.rounded(2)));
            attribute.end();
        }
        if (quantities.isEmpty()) {
            throw group.refused("attributes", "must name at least one attribute");
        }
        return sensor(group, identity, number, own, quantities);
    }

    private SimulatedDevice sensor(
            ScenarioObjectReader group, Identity identity, long number, long own, List<Quantity> sound)
            throws InvalidScenarioException {
        List<Quantity> all = new ArrayList<>(sound);
        all.addAll(battery(group, own));
        List<String> names =
                all.stream().map(quantity -> quantity.attribute().name()).toList();
        List<FaultReader.Wrong> wrongs = faults.faults(group, number, own, names);
        List<Quantity> shown = all.stream()
                .map(quantity -> new Quantity(quantity.attribute(), faulty(quantity, wrongs)))
                .toList();
        return new SimulatedDevice.Sensor(identity, group.duration("period"), place(group, number, own), shown);
    }

    private SimulatedDevice camera(ScenarioObjectReader group, Identity identity, long number, long own)
            throws InvalidScenarioException {
        Double heading = group.has("heading") ? Double.valueOf(group.number("heading", 0, 360)) : null;
        List<TimeWindow> silent = faults.faults(group, number, own, List.of()).stream()
                .map(wrong -> wrong.fault().during())
                .toList();
        return new SimulatedDevice.Camera(
                identity, group.duration("period"), place(group, number, own), heading, silent, battery(group, own));
    }

    /** The charge of its battery, if the entry states how long one lasts. */
    private static List<Quantity> battery(ScenarioObjectReader group, long own) throws InvalidScenarioException {
        if (!group.has("battery")) {
            return List.of();
        }
        Duration life = atLeastAMillisecond(group, "battery");
        return List.of(new Quantity(
                new DeviceRegistration.Attribute("bat", "battery", "Float"),
                Curves.batteryLevel(life, RandomStream.seed(own, "battery")).rounded(3)));
    }

    private SimulatedDevice robot(ScenarioObjectReader group, Identity identity, Duration period)
            throws InvalidScenarioException {
        Trajectory way = places.way(group);
        RobotModel model = new RobotModel(
                identity.id(),
                way,
                group.number("meeting", 0, 1000, 0),
                group.duration("patience", Duration.ofSeconds(20)));
        double driven = group.number("start", 0, 1e9, 0) / way.speed();
        double workingWidth = group.number("width", 0, 100, 0);
        boolean reportsMission = group.truth("tellsMission", true);
        return new SimulatedDevice.Robot(identity, period, model, driven, workingWidth, reportsMission);
    }

    private static Duration atLeastAMillisecond(ScenarioObjectReader json, String name)
            throws InvalidScenarioException {
        Duration duration = json.duration(name);
        if (duration.toMillis() < 1) {
            throw json.refused(name, "must be at least PT0.001S");
        }
        return duration;
    }

    private Place place(ScenarioObjectReader group, long number, long own) throws InvalidScenarioException {
        if (!group.has("carriedBy")) {
            return places.place(group, RandomStream.seed(own, "place"));
        }
        PlaceReader.once(group, "area", "at", "route", "carriedBy");
        // A group may be carried by a group, the nth by the nth: resolved when all devices are known.
        String carrier = group.text("carriedBy");
        return new Place(group.reported("where", ""), null, group.has("count") ? carrier + "-" + number : carrier);
    }

    private static Weather weather(ScenarioObjectReader group, long own) throws InvalidScenarioException {
        return new Weather(group.number("meanCelsius", COLDEST, HOTTEST, 18), own);
    }

    private static Signal faulty(Quantity sound, List<FaultReader.Wrong> wrongs) {
        Signal signal = sound.signal();
        for (FaultReader.Wrong wrong : wrongs) {
            if (wrong.attribute() == null
                    || wrong.attribute().equals(sound.attribute().name())) {
                signal = wrong.fault().on(signal);
            }
        }
        return signal;
    }

    private static List<Quantity> quantities(String type, Weather weather) {
        return MeasuredAttribute.ofType(type).stream()
                .map(each -> new Quantity(
                        new DeviceRegistration.Attribute(each.objectId(), each.name(), each.type()),
                        signal(each.name(), weather)))
                .toList();
    }

    private static Signal signal(String attribute, Weather weather) {
        return switch (attribute) {
            case "Temperature" -> weather.temperature();
            case "Humidity" -> weather.humidity();
            case "Pressure" -> weather.pressure();
            case "WindSpeed" -> weather.windSpeed();
            case "WindDirection" -> weather.windDirection();
            case "Rain" -> weather.rain();
            case "SolarRadiation" -> weather.radiation();
            default -> throw new IllegalArgumentException("no signal simulates the attribute " + attribute);
        };
    }
}
