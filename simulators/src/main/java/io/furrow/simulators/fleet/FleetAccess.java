package io.furrow.simulators.fleet;

import java.util.function.Supplier;

import io.furrow.model.device.FarmSecret;
import io.furrow.simulators.device.FleetSettings;
import io.furrow.simulators.mqtt.MqttAccess;
import io.furrow.simulators.scenario.SimulatedDevice;

/**
 * Where a fleet reports, and as whom.
 *
 * @param fiware IoT Agent, context broker, tenant
 * @param mqtt the MQTT broker
 * @param logins at the MQTT broker
 */
public record FleetAccess(FleetSettings fiware, MqttAccess mqtt, Logins logins) {
    /** As whom each connection is opened. */
    public interface Logins {
        MqttAccess.Login device(SimulatedDevice.Identity device);

        MqttAccess.Login gateway(String mission);

        /** One for all. */
        static Logins all(MqttAccess.Login login) {
            return new Logins() {
                @Override
                public MqttAccess.Login device(SimulatedDevice.Identity device) {
                    return login;
                }

                @Override
                public MqttAccess.Login gateway(String mission) {
                    return login;
                }
            };
        }

        /**
         * As the control plane provisions them.
         *
         * @param secret as it is now
         */
        static Logins of(Supplier<FarmSecret> secret) {
            return new Logins() {
                @Override
                public MqttAccess.Login device(SimulatedDevice.Identity device) {
                    return login(secret.get().device(device.mission(), device.id(), device.generation()));
                }

                @Override
                public MqttAccess.Login gateway(String mission) {
                    return login(secret.get().gateway(mission));
                }

                private MqttAccess.Login login(FarmSecret.Login login) {
                    return new MqttAccess.Login(login.user(), login.password());
                }
            };
        }
    }

    /** All as the user of the settings, at QoS 1, trusting whom the JDK trusts. */
    public static FleetAccess of(FleetSettings settings) {
        return new FleetAccess(
                settings,
                new MqttAccess(settings.mqtt(), null, 1),
                Logins.all(new MqttAccess.Login(settings.mqttUser(), settings.mqttPassword())));
    }
}
