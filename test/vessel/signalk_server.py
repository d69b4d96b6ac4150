"""The real Signal K server of test/vessel/server, on a loopback port and a configuration folder of its own."""
import json
import os
import shutil
import signal
import socket
import ssl
import subprocess
import sys
import tempfile
import time
import urllib.error
import urllib.request

HERE = os.path.dirname(os.path.abspath(__file__))
SKIPPED = 77
SELF = "urn:mrn:signalk:uuid:c0d79334-4e25-4245-8892-54e8ccc8021d"
# What the tests need and nothing else: no discovery, no plugins, no other ports.
SETTINGS = {"mdns": False, "ssl": False, "wsPingInterval": 5000,
            "interfaces": {"plugins": False, "webapps": False, "appstore": False, "tcp": False, "nmea-tcp": False,
                           "applicationData": False, "playground": False, "logfiles": False, "wasm": False},
            "pipedProviders": []}


def skip(why):
    print(f"SKIPPED: {why}", flush=True)
    sys.exit(SKIPPED)


def server_folder():
    """The folder whose server fits this machine's Node; ends the test as skipped when there is none."""
    node = shutil.which("node")
    if node is None:
        skip("there is no node; script/get_signalk installs it and the Signal K server")
    major = int(subprocess.run([node, "--version"], capture_output=True, text=True, check=True).stdout[1:].split(".")[0])
    folder = os.path.join(HERE, "server", "node20" if major >= 20 else "node18")
    # npm writes its own copy of the lock file when it is done: half a server is none.
    if not os.path.exists(os.path.join(folder, "node_modules", ".package-lock.json")):
        skip(f"the Signal K server for Node {major} is not installed; script/get_signalk does it")
    return folder


class Server:
    """Started anew it keeps port and configuration."""

    def __init__(self, security=False, tls=False, webapp=None):
        """`webapp`: folder of a web app that it is to host."""
        self.folder = server_folder()
        self.directory = tempfile.mkdtemp(prefix="signalk_")
        self.socket = socket.socket()
        self.socket.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        self.socket.bind(("127.0.0.1", 0))
        self.port = self.socket.getsockname()[1]
        self.token = None
        self.process = None
        self.certificate = None
        if tls:
            self.make_certificate()
        self.write("settings.json", dict(SETTINGS, ssl=tls, interfaces=dict(SETTINGS["interfaces"], webapps=webapp is not None),
                                         **({"security": {"strategy": "./tokensecurity"}} if security else {})))
        if webapp is not None:
            with open(os.path.join(webapp, "package.json"), encoding="utf-8") as file:
                name = json.load(file)["name"]
            os.mkdir(os.path.join(self.directory, "node_modules"))
            shutil.copytree(webapp, os.path.join(self.directory, "node_modules", name))
            self.write("package.json", {"name": "server", "dependencies": {name: "*"}})
        self.write("defaults.json", {"vessels": {"self": {"uuid": SELF, "name": "barge"}}})
        if security:
            secret = "not a secret: a test's"
            self.write("security.json", {"allow_readonly": True, "secretKey": secret, "acls": [], "devices": [],
                                         "allowDeviceAccessRequests": False, "allowNewUserRegistration": False,
                                         "users": [{"username": "link", "type": "readwrite", "password": "-"}]})
            os.chmod(os.path.join(self.directory, "security.json"), 0o600)
            self.token = subprocess.run(
                ["node", os.path.join(self.folder, "node_modules/signalk-server/bin/signalk-generate-token"),
                 "-u", "link", "-e", "1h", "-s", os.path.join(self.directory, "security.json")],
                capture_output=True, text=True, check=True).stdout.strip()

    def make_certificate(self):
        """Self-signed, for the loopback address."""
        self.certificate, key = (os.path.join(self.directory, name) for name in ("ssl-cert.pem", "ssl-key.pem"))
        subprocess.run(["openssl", "req", "-x509", "-newkey", "rsa:2048", "-nodes", "-days", "1", "-subj", "/CN=barge",
                        "-addext", "subjectAltName=IP:127.0.0.1", "-keyout", key, "-out", self.certificate],
                       check=True, capture_output=True)
        for path in (self.certificate, key):
            os.chmod(path, 0o600)

    def write(self, name, content):
        with open(os.path.join(self.directory, name), "w", encoding="utf-8") as file:
            json.dump(content, file)

    def start(self, limit_s=300.0):
        if self.socket is None:  # the killed server had the only other copy
            self.socket = socket.socket()
            self.socket.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            self.socket.bind(("127.0.0.1", self.port))
        environment = dict(os.environ, LISTEN_FDS="1", SIGNALK_DISABLE_SERVER_UPDATES="1", HOME=self.directory,
                           NODE_ENV="production")
        listening = self.socket

        def hand_over():
            os.dup2(listening.fileno(), 3)
            os.set_inheritable(3, True)
        self.log = open(os.path.join(self.directory, "server.log"), "ab")
        # close_fds would close the third again: everything else of Python's is closed on exec anyway.
        self.process = subprocess.Popen(
            ["node", os.path.join(self.folder, "node_modules/signalk-server/bin/signalk-server"), "-c", self.directory],
            env=environment, close_fds=False, preexec_fn=hand_over, cwd=self.directory, stdin=subprocess.DEVNULL,
            stdout=self.log, stderr=subprocess.STDOUT)
        self.socket.close()
        self.socket = None
        end = time.monotonic() + limit_s
        while self.get("/signalk") is None:
            if self.process.poll() is not None or time.monotonic() > end:
                with open(self.log.name, encoding="utf-8", errors="replace") as file:
                    raise AssertionError("the Signal K server did not start:\n" + file.read()[-3000:])
            time.sleep(0.2)

    def get(self, path):
        """Parsed answer; None where there is none."""
        headers = {"Authorization": f"Bearer {self.token}"} if self.token else {}
        scheme, context = "http", None
        if self.certificate:
            scheme, context = "https", ssl.create_default_context(cafile=self.certificate)
        try:
            with urllib.request.urlopen(urllib.request.Request(f"{scheme}://127.0.0.1:{self.port}{path}", headers=headers),
                                        timeout=2.0, context=context) as answer:
                return json.load(answer)
        except (urllib.error.URLError, OSError, ValueError):
            return None

    def own(self, path):
        """What the server knows of a path of its own vessel."""
        return self.get("/signalk/v1/api/vessels/self/" + path.replace(".", "/"))

    def signal(self, number):
        self.process.send_signal(number)

    def kill(self):
        if self.process is not None:
            self.process.send_signal(signal.SIGCONT)
            self.process.kill()
            self.process.wait()
            self.log.close()
        self.process = None

    def close(self):
        self.kill()
        if self.socket is not None:
            self.socket.close()
        shutil.rmtree(self.directory, ignore_errors=True)


class Probe:
    """vessel_probe signalk, spoken to in JSON lines."""

    def __init__(self, program, port, environment=None, **options):
        self.process = subprocess.Popen([program, "signalk", json.dumps(dict(options, port=port))], text=True,
                                        stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                        env=dict(os.environ, **(environment or {})))
        self.inputs = []

    def say(self, **command):
        self.process.stdin.write(json.dumps(command) + "\n")
        self.process.stdin.flush()

    def send(self, values):
        self.say(send=values)

    def health(self):
        self.say(health=True)
        while True:
            line = json.loads(self.process.stdout.readline())
            if "state" in line:
                return line
            self.inputs.append(line)

    def memory_kib(self):
        with open(f"/proc/{self.process.pid}/status", encoding="utf-8") as file:
            return next(int(line.split()[1]) for line in file if line.startswith("VmRSS"))

    def close(self):
        """What it wrote beside its answers; ends at once whatever its peer does: peers that wait do so for 15 s."""
        begin = time.monotonic()
        _, error = self.process.communicate(timeout=30.0)
        took = time.monotonic() - begin
        assert took < 8.0, f"took {took:.1f} s to end"
        assert self.process.returncode == 0, error
        return error


def eventually(condition, what, limit_s=60.0):
    """`what`: words, or a function that says at the end what is missing."""
    end = time.monotonic() + limit_s
    while True:
        result = condition()
        if result:
            return result
        assert time.monotonic() < end, f"not within {limit_s} s: {what() if callable(what) else what}"
        time.sleep(0.1)
