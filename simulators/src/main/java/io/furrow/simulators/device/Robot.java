package io.furrow.simulators.device;

import java.net.http.HttpResponse;
import java.time.Duration;
import java.time.Instant;
import java.util.concurrent.CompletableFuture;

import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.EntityBuilder;
import io.furrow.model.ngsi.Position;
import io.furrow.simulators.robot.FirosEntity;

/**
 * A robot as FIROS shows it: written to the context broker directly, its position a ROS NavSatFix message as text in
 * attribute {@code gnss}, quotes escaped as {@code %27}. One request at a time keeps its fixes in order; a fix that comes
 * while the broker has not answered the last one is dropped, as FIROS does.
 */
final class Robot implements Device {
    private static final Logger LOG = LoggerFactory.getLogger(Robot.class);

    private final FleetSettings settings;
    private final FiwareHttp http;
    private final Scenario.Assignment assignment;
    private final Path path;
    private final Instant start;
    private CompletableFuture<Void> last = CompletableFuture.completedFuture(null);
    private volatile boolean away;

    /** @param assignment of a {@link DevicePlan.RobotPlan} */
    Robot(FleetSettings settings, FiwareHttp http, Scenario.Assignment assignment, Instant start) {
        this.settings = settings;
        this.http = http;
        this.assignment = assignment;
        this.path = assignment.device().route().path();
        this.start = start;
    }

    @Override
    public void report(Instant now) {
        if (!last.isDone()) {
            return;
        }
        ObjectNode body = JsonNodeFactory.instance.objectNode().put("actionType", "append");
        body.putArray("entities").add(entity(now).json());
        last = http.postAsync(settings.contextBroker(), "/v2/op/update", body).handle(this::note);
    }

    @Override
    public void close() {
        last.cancel(true);
    }

    Entity entity(Instant now) {
        DevicePlan device = assignment.device();
        Position place = path.at(Duration.between(start, now));
        EntityBuilder entity = FirosEntity.located(device.entity(), place, now);
        if (device instanceof DevicePlan.RobotPlan plan && plan.tellsMission()) {
            entity.text("Domain", assignment.domain()).text("Mission", assignment.mission());
        }
        return entity.build();
    }

    /** Says once that fixes do not arrive, and once that they do again. */
    private Void note(HttpResponse<String> answer, Throwable failure) {
        boolean arrived = failure == null && answer.statusCode() / 100 == 2;
        if (!arrived && !away) {
            String reason = failure == null ? answer.statusCode() + " " + answer.body() : failure.toString();
            LOG.warn(
                    "{}: {} does not take its position: {}",
                    assignment.device().id(),
                    settings.contextBroker(),
                    reason);
        } else if (arrived && away) {
            LOG.info("{}: its position arrives again", assignment.device().id());
        }
        away = !arrived;
        return null;
    }
}
