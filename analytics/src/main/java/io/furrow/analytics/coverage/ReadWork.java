package io.furrow.analytics.coverage;

import java.util.EnumSet;
import java.util.Locale;
import java.util.Set;
import java.util.regex.Matcher;
import java.util.regex.Pattern;

import org.apache.flink.api.common.functions.OpenContext;
import org.apache.flink.metrics.Counter;
import org.apache.flink.util.Collector;

import io.furrow.analytics.coverage.WorkReport.Work;
import io.furrow.analytics.position.Device;
import io.furrow.analytics.position.DeviceInfo;
import io.furrow.analytics.position.PositionFix;
import io.furrow.analytics.position.ReadEntities;
import io.furrow.flink.record.Epochs;
import io.furrow.flink.record.TopicRecord;
import io.furrow.flink.time.ClockSkewLimit;
import io.furrow.flink.time.ReplayKind;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.ngsi.Quantity;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.position.EntityReader;
import io.furrow.model.position.Position;
import io.furrow.model.position.PositionReading;

/**
 * Extracts positions, working widths and states of implements. Impossible positions are counted as {@code positionsFaulty}, impossible
 * widths as {@code widthsFaulty}; entities with none of the three are skipped.
 */
final class ReadWork extends ReadEntities<WorkReport> {
    private static final long serialVersionUID = 1L;
    /** The text of a ROS message {@code std_msgs}, as FIROS writes it. */
    private static final Pattern ROS_DATA = Pattern.compile("\\{\\s*%27data%27\\s*:\\s*(?:%27)?(.*?)(?:%27)?\\s*}");

    private final WorkAttributes attributes;
    private transient Counter positionsFaulty;
    private transient Counter widthsFaulty;

    ReadWork(WorkAttributes attributes, ClockSkewLimit ahead) {
        super(
                "coverage",
                EnumSet.of(ReplayKind.EVENT, ReplayKind.PRIME),
                Set.of("Mission", attributes.width(), attributes.work()),
                ahead);
        this.attributes = attributes;
    }

    @Override
    public void open(OpenContext context) {
        super.open(context);
        positionsFaulty = counter("positionsFaulty");
        widthsFaulty = counter("widthsFaulty");
    }

    @Override
    protected boolean extract(EntityReader entity, TopicRecord record, Collector<WorkReport> out)
            throws UnreadableException {
        if (!attributes.isRobot(entity.type())) {
            return false;
        }
        PositionReading reading = PositionReading.of(record.headers(), entity::position);
        double width = width(entity);
        Work work = work(entity);
        if (reading instanceof PositionReading.Faulty) {
            positionsFaulty.inc();
        }
        if (reading.usable().isEmpty() && Double.isNaN(width) && work == Work.UNKNOWN) {
            return !(reading instanceof PositionReading.Absent);
        }
        out.collect(new WorkReport(fix(entity, reading, record), width, work));
        return true;
    }

    private double width(EntityReader entity) {
        if (!entity.has(attributes.width())) {
            return Double.NaN;
        }
        double width = entity.number(attributes.width(), Quantity.LENGTH);
        if (!CoverageRules.isWidth(width)) {
            widthsFaulty.inc();
            return Double.NaN;
        }
        return width;
    }

    private Work work(EntityReader entity) {
        if (!entity.has(attributes.work())) {
            return Work.UNKNOWN;
        }
        double number = entity.number(attributes.work());
        String state = entity.truth(attributes.work())
                .map(String::valueOf)
                .or(() -> entity.text(attributes.work()))
                .orElse(number == 1 ? "1" : "");
        Matcher ros = ROS_DATA.matcher(state);
        String word = (ros.matches() ? ros.group(1) : state).trim().toLowerCase(Locale.ROOT);
        return attributes.on().contains(word) ? Work.ON : Work.OFF;
    }

    private static PositionFix fix(EntityReader entity, PositionReading reading, TopicRecord record)
            throws UnreadableException {
        FiwareScope scope = FiwareScope.of(record.headers());
        Position position = reading.usable().orElse(new Position(Double.NaN, Double.NaN));
        Device device = new Device(record.topic(), scope.identity(entity.type(), entity.id()));
        String mission = entity.name("Mission").orElse("");
        return new PositionFix(
                DeviceInfo.of(device, entity.id(), entity.type(), mission, ""),
                position.latitude(),
                position.longitude(),
                Double.NaN,
                Double.NaN,
                Epochs.timeOf(record));
    }
}
