// Read by Node before the agent: gives it the variables that are in files, so that 'docker inspect' does not show them.
const { readFileSync } = require('fs');

const secret = (name) => readFileSync(`/run/secrets/${name}`, 'utf8').trim();
process.env.IOTA_MONGO_URI = secret('mongo/uri').replace('/?', '/iotagentjson?');
process.env.IOTA_MQTT_PASSWORD = secret('mqtt/password');
