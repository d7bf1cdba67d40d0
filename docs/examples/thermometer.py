#!/usr/bin/env python3
"""A thermometer: reports each PERIOD seconds and answers commands. Reads MQTT_HOST, MQTT_PORT, MQTT_USER, … from the environment."""
import json, os, random, time
import paho.mqtt.client as mqtt

PERIOD = float(os.environ.get("PERIOD", "10"))


def on_connect(client, _, __, reason, ___):
    print("connected" if not reason.is_failure else f"refused: {reason}", flush=True)
    client.subscribe(os.environ["MQTT_COMMANDS"], qos=1)


def on_message(client, _, message):
    command = json.loads(message.payload)  # {"off": ""}
    print("asked:", command, flush=True)
    client.publish(os.environ["MQTT_RESULTS"], json.dumps({name: "OK" for name in command}), qos=1)


client = mqtt.Client(mqtt.CallbackAPIVersion.VERSION2, client_id=os.environ["MQTT_DEVICE_ID"], clean_session=False)
client.username_pw_set(os.environ["MQTT_USER"], os.environ["MQTT_PASSWORD"])
if os.environ.get("MQTT_TLS") == "true":
    client.tls_set(os.environ.get("MQTT_CA"))
client.on_connect, client.on_message = on_connect, on_message
client.connect_async(os.environ["MQTT_HOST"], int(os.environ["MQTT_PORT"]))
client.loop_start()  # connects, and again whenever the connection is lost
while True:
    measure = {"temp": round(random.gauss(21, 0.2), 2), "time": int(time.time() * 1000)}
    client.publish(os.environ["MQTT_MEASURES"], json.dumps(measure), qos=1)
    time.sleep(PERIOD)
